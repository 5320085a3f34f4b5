// Occlusion of many receivers, by any method, watched by a progress bar and checked ray by ray where asked.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "cli/progress_bar.h"
#include "image/metrics.h"
#include "lkao/ambient_occlusion.h"
#include "reference/embree_reference.h"

namespace lkao::cli {

enum class Method {
  bvh,     // the library's traversal
  embree,  // the same rays through Embree
  raster,  // OpenGL
};
const char* name_of(Method method);
// What a method is checked against: Embree, which is checked against the traversal.
Method other_than(Method method);

// Answers as AmbientOcclusion::query does, but may leave blocked rays uncounted; the last argument is the first
// receiver's index.
using Answer = std::function<QueryReport(std::span<const Receiver>, const QueryOutputs&, std::uint64_t)>;
// The query's own. `ao` must outlive it.
Answer answer_of(const AmbientOcclusion& ao);
// Embree's, for the rays of `ao`. Both must outlive it.
Answer answer_of(const reference::EmbreeReference& embree, const AmbientOcclusion& ao);

// A method at work.
struct Caster {
  Method method;
  Answer answer;
};

struct BatchOptions {
  std::optional<Caster> check;  // run this method too, and compare
  bool bent_normals = false;
};

// How the other method's answers for the same rays differ.
struct BatchCheck {
  Method method = Method::embree;
  std::uint64_t mismatched_ray_count = 0;
  double ray_mismatch_rate = 0;  // of the cast rays
  image::Metrics occlusion;
  double seconds = 0;
};

struct Batch {
  std::vector<float> occlusion;         // one a receiver
  std::vector<glm::vec3> bent_normals;  // one a receiver, or none
  std::uint64_t ray_count = 0;          // cast
  std::size_t invalid_receiver_count = 0;
  double seconds = 0;  // of the answers alone
  std::optional<BatchCheck> check;

  // Mean over the valid receivers; NaN where there is none.
  double occlusion_mean() const;
};

// Asks for every receiver; receiver k has index k. `pattern` is that of the answers. A method and its check take turns
// on small parts of the receivers, so that the masks of few receivers are in memory at a time.
Batch run_batch(const Caster& caster, const SamplePattern& pattern, std::span<const Receiver> receivers,
                const BatchOptions& options, ProgressBar& progress);

// Millions of rays a second; 0 where no time was measured.
double mrays_per_second(std::uint64_t ray_count, double seconds);

}  // namespace lkao::cli
