// Batches: the caller's arrays, a part of them at a time, as the C++ interface wants them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "c_api/arrays.h"
#include "c_api/convert.h"
#include "c_api/versioned.h"
#include "lkao/c.h"
#include "lkao/lkao.h"

namespace lkao::c_api {

// Receivers that are answered at a time: enough to keep all threads busy, and some megabytes.
inline constexpr std::size_t kPart = std::size_t{1} << 15;

class Receivers {
 public:
  explicit Receivers(const lkao_receivers& from)
      : count_(from.count),
        positions_(from.positions, from.position_stride, "receivers->position_stride"),
        normals_(from.normals, from.normal_stride, "receivers->normal_stride"),
        geometric_normals_(from.geometric_normals, from.geometric_normal_stride, "receivers->geometric_normal_stride"),
        excluded_(from.excluded_primitives, from.excluded_primitive_stride, "receivers->excluded_primitive_stride"),
        instances_(from.excluded_instances, from.excluded_instance_stride, "receivers->excluded_instance_stride"),
        groups_(from.occluder_groups, from.occluder_group_stride, "receivers->occluder_group_stride") {
    if (count_ == 0) return;
    needed(from.positions, "receivers->positions");
    needed(from.normals, "receivers->normals");
  }

  std::size_t count() const { return count_; }

  // Those from `first` on.
  void get(std::size_t first, std::span<Receiver> part) const {
    for (std::size_t k = 0; k < part.size(); ++k) {
      part[k] = {};
      positions_.get(first + k, &part[k].position);
      normals_.get(first + k, &part[k].normal);
      if (geometric_normals_) geometric_normals_.get(first + k, &part[k].geometric_normal);
      if (excluded_) excluded_.get(first + k, &part[k].excluded_primitive);
      if (instances_) instances_.get(first + k, &part[k].excluded_instance);
      if (groups_) groups_.get(first + k, &part[k].occluder_groups);
    }
  }

 private:
  std::size_t count_;
  Strided<const float, 3> positions_, normals_, geometric_normals_;
  Strided<const std::uint32_t, 1> excluded_, instances_, groups_;
};

// One array of answers. Where the caller's is not packed, those of a part wait in one of its own.
template <typename Value>
class Output {
 public:
  // `width` values make an entry.
  Output(void* first, std::size_t stride, std::size_t width, const char* name)
      : first_(static_cast<unsigned char*>(first)),
        width_(width),
        stride_(checked_stride(stride, width * sizeof(Value), name)) {}

  // Where answers `first` and on go: empty where they are not wanted.
  std::span<Value> begin(std::size_t first, std::size_t count) {
    if (first_ == nullptr) return {};
    if (is_packed()) return {reinterpret_cast<Value*>(first_ + first * stride_), count * width_};
    waiting_.resize(count * width_);
    return waiting_;
  }
  void finish(std::size_t first, std::size_t count) const {
    if (first_ == nullptr || is_packed()) return;
    for (std::size_t k = 0; k < count; ++k) {
      std::memcpy(first_ + (first + k) * stride_, waiting_.data() + k * width_, width_ * sizeof(Value));
    }
  }

 private:
  bool is_packed() const { return stride_ == width_ * sizeof(Value); }

  unsigned char* first_;
  std::size_t width_, stride_;
  std::vector<Value> waiting_;
};

inline void add(lkao_query_report& sum, const QueryReport& part) {
  sum.receiver_count += part.receiver_count;
  sum.invalid_receiver_count += part.invalid_receiver_count;
  sum.ray_count += part.ray_count;
  sum.blocked_ray_count += part.blocked_ray_count;
}

// The caller's progress, to which all parts are one call. `weight`: how often the parts count each receiver.
inline Progress progress_from(const Progress& progress, std::size_t first, std::size_t count, std::size_t weight) {
  if (!progress) return {};
  return [=](std::size_t done, std::size_t) { return progress(weight * first + done, weight * count); };
}

// Calls `answer_part(first, receivers, index, progress)`, which returns its QueryReport, for part after part.
template <typename AnswerPart>
void answer_batch(const lkao_receivers* receivers, const lkao_batch_options* options, lkao_query_report* report,
                  const AnswerPart& answer_part, std::size_t progress_weight = 1) {
  const Receivers all(read(receivers, LKAO_RECEIVERS_INIT, "receivers"));
  const lkao_batch_options how = read_or_defaults(options, LKAO_BATCH_OPTIONS_INIT, "options");
  if (report != nullptr) check_size(report, "report");
  lkao_query_report sum = LKAO_QUERY_REPORT_INIT;
  const Progress progress = progress_of(how.progress, how.progress_user);
  run_on_threads(how.thread_count, "options->thread_count", [&] {
    std::vector<Receiver> part;
    for (std::size_t first = 0; first < all.count(); first += part.size()) {
      part.resize(std::min(kPart, all.count() - first));
      all.get(first, part);
      add(sum, answer_part(first, std::span<const Receiver>(part), how.first_index + first,
                           progress_from(progress, first, all.count(), progress_weight)));
    }
  });
  if (report != nullptr) write(sum, report);
}

}  // namespace lkao::c_api
