#include "bench/rays_cell.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <glm/common.hpp>

#include "bench/embree_modes.h"
#include "lkao/isa.h"
#include "lkao/neighbourhood.h"

namespace lkao::bench {
namespace {

// What a renderer does that has no batches: a call for every receiver.
void query_singly(const AmbientOcclusion& ao, std::span<const Receiver> receivers, Masks& masks) {
  const auto word_count = static_cast<std::size_t>(ao.pattern().word_count());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, receivers.size(), 32), [&](const auto& range) {
    for (std::size_t k = range.begin(); k < range.end(); ++k) {
      const ReceiverOcclusion answer = ao.query(receivers[k], k);
      std::copy_n(answer.mask.words, word_count, masks.data() + k * word_count);
    }
  });
}

// What one does that shades tile by tile.
void query_around(const AmbientOcclusion& ao, std::span<const Receiver> receivers, Masks& masks) {
  const auto word_count = static_cast<std::size_t>(ao.pattern().word_count());
  const auto answer_tile = [&](const tbb::blocked_range<std::size_t>& range) {
    Bounds positions{receivers[range.begin()].position, receivers[range.begin()].position};
    for (const Receiver& receiver : receivers.subspan(range.begin(), range.size())) {
      positions = {glm::min(positions.lower, receiver.position), glm::max(positions.upper, receiver.position)};
    }
    Neighbourhood here = ao.around(positions);
    for (std::size_t k = range.begin(); k < range.end(); ++k) {
      std::copy_n(here.blocked(receivers[k], k).words, word_count, masks.data() + k * word_count);
    }
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, receivers.size(), 64), answer_tile, tbb::simple_partitioner());
}

struct Queries {
  AmbientOcclusion simd;
  AmbientOcclusion scalar;
};

Queries make_queries(const CellInput& input, const Cell& cell) {
  const SamplePattern& pattern = SamplePattern::standard(cell.ray_count);
  const auto make = [&](Kernel kernel) {
    return AmbientOcclusion(*input.occluders, pattern, {.radius = cell.radius}, kernel);
  };
  return {make(Kernel::simd), make(Kernel::scalar)};
}

// Cell::simd, single and around count on their places.
std::vector<Rival> make_rivals(const CellInput& input, const Queries& queries, int round_count, bool with_scalar) {
  const std::span<const Receiver> receivers = input.receivers;
  const Masks masks(receivers.size() * static_cast<std::size_t>(queries.simd.pattern().word_count()));
  const auto batch = [receivers](const AmbientOcclusion& ao) {
    return [receivers, &ao](Masks& to) { ao.query(receivers, {.mask_words = to}); };
  };
  const AmbientOcclusion& simd = queries.simd;
  std::vector<Rival> rivals = {
      {kSimdMethod, round_count, batch(simd), masks},
      {kSingleMethod, round_count, [receivers, &simd](Masks& to) { query_singly(simd, receivers, to); }, masks},
      {kAroundMethod, round_count, [receivers, &simd](Masks& to) { query_around(simd, receivers, to); }, masks}};
  if (with_scalar) rivals.push_back({kScalarMethod, 1, batch(queries.scalar), masks});
  for (const EmbreeMode& mode : all_embree_modes()) {
    const auto answer = [receivers, &simd, mode, rival = input.rival](Masks& to) {
      cast(mode, rival->plain(), simd, receivers, to);
    };
    rivals.push_back({mode.name(), round_count, answer, masks});
  }
  return rivals;
}

}  // namespace

const MethodResult* Cell::scalar() const { return fastest(results, kScalarMethod); }

const MethodResult& Cell::best_embree() const { return *fastest(results, "embree"); }

const MethodResult& Cell::occluded1() const { return *fastest(results, "embree1_"); }

std::vector<Cell> measure(const CellInput& input, const MeasureOptions& options, const Cell& question,
                          bool with_scalar) {
  force_isa(question.isa.lkao);
  const Queries queries = make_queries(input, question);
  Masks expected(input.receivers.size() * static_cast<std::size_t>(queries.simd.pattern().word_count()));
  const std::uint64_t ray_count =
      input.oracle->query(queries.simd, input.receivers, {.mask_words = expected}).ray_count;

  std::vector<Cell> cells;
  for (const int thread_count : options.thread_counts) {
    std::vector<Rival> rivals = make_rivals(input, queries, options.round_count, with_scalar && cells.empty());
    run_rounds(rivals, thread_count);
    Cell cell = question;
    cell.thread_count = thread_count;
    for (const Rival& rival : rivals)
      cell.results.push_back(result_of(rival, expected, static_cast<double>(ray_count)));
    cells.push_back(std::move(cell));
  }
  return cells;
}

}  // namespace lkao::bench
