#include "fuzz/query_check.h"

#include <bit>
#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "query/receiver_rays.h"
#include "support/brute_force.h"

namespace lkao::tests {
namespace {

using Answers = std::vector<ReceiverOcclusion>;

// Bit for bit, but any NaN equals any other.
bool equal(float a, float b) {
  return (std::isnan(a) && std::isnan(b)) || std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}
bool equal(const glm::vec3& a, const glm::vec3& b) { return equal(a.x, b.x) && equal(a.y, b.y) && equal(a.z, b.z); }
bool equal(const ReceiverOcclusion& a, const ReceiverOcclusion& b) {
  return a.mask == b.mask && equal(a.occlusion, b.occlusion) && equal(a.bent_normal, b.bent_normal);
}

std::string text(const glm::vec3& v) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", v.x, v.y, v.z); }

std::string text(const ReceiverOcclusion& answer) {
  return fmt::format("occlusion {:.9g}, bent normal {}", answer.occlusion, text(answer.bent_normal));
}

std::string differing_rays(const OcclusionMask& a, const OcclusionMask& b) {
  std::vector<int> rays;
  for (int ray = 0; ray < kMaxRayCount; ++ray) {
    if (a.test(ray) != b.test(ray)) rays.push_back(ray);
  }
  return rays.empty() ? "no ray" : fmt::format("rays {}", fmt::join(rays, " "));
}

std::string describe(const QueryCase& c, std::size_t receiver) {
  const Receiver& r = c.receivers[receiver];
  const RayOptions& o = c.options;
  return fmt::format(
      "  receiver {} of {}: position {}, normal {}, geometric normal {}, excluded primitive {}, index {}\n"
      "  {} triangles, spatial splits {}, pattern {}, radius {:.9g}, {}-sided, jitter {:g} turns {:g} rad, seed {}, "
      "surface offset {:g}, min distance {:.9g}, level end {:.9g}\n",
      receiver, c.receivers.size(), text(r.position), text(r.normal), text(r.geometric_normal),
      r.excluded_primitive == kNoPrimitive ? "none" : std::to_string(r.excluded_primitive), c.first_index + receiver,
      c.mesh.triangles.size(), c.build.spatial_splits ? "on" : "off", c.pattern_name, o.radius,
      o.sidedness == Sidedness::one_sided ? "one" : "two", o.jitter.rotation, o.jitter.tilt, o.seed, o.surface_offset,
      o.min_distance, c.level_end);
}

std::string compare(const QueryCase& c, const std::string& name, const Answers& answers,
                    const std::string& expected_name, const Answers& expected) {
  for (std::size_t k = 0; k < answers.size(); ++k) {
    if (equal(answers[k], expected[k])) continue;
    return fmt::format("{} differs from {} in {}\n  {}: {}\n  {}: {}\n{}", name, expected_name,
                       differing_rays(answers[k].mask, expected[k].mask), name, text(answers[k]), expected_name,
                       text(expected[k]), describe(c, k));
  }
  return "";
}

Answers one_by_one(const QueryCase& c, const AmbientOcclusion& ao) {
  Answers answers;
  for (std::size_t k = 0; k < c.receivers.size(); ++k) answers.push_back(ao.query(c.receivers[k], c.first_index + k));
  return answers;
}

Answers as_batch(const QueryCase& c, const AmbientOcclusion& ao) {
  const std::size_t count = c.receivers.size(), word_count = static_cast<std::size_t>(ao.pattern().word_count());
  std::vector<float> occlusion(count);
  std::vector<glm::vec3> bent_normals(count);
  std::vector<std::uint64_t> words(count * word_count);
  ao.query(c.receivers, {occlusion, bent_normals, words}, c.first_index);
  Answers answers(count);
  for (std::size_t k = 0; k < count; ++k) {
    answers[k] = {occlusion[k], bent_normals[k], {}};
    std::memcpy(answers[k].mask.words, &words[k * word_count], word_count * sizeof(std::uint64_t));
  }
  return answers;
}

// Masks of every triangle, one after the other; what else is in an answer follows from them and is not looked at.
Answers by_brute_force(const QueryCase& c, const AmbientOcclusion& ao, const Answers& scalar) {
  Answers answers = scalar;
  for (std::size_t k = 0; k < c.receivers.size(); ++k) {
    const ReceiverRays rays = ao.rays(c.receivers[k], c.first_index + k);
    const query::PatternLanes lanes(c.pattern, std::isinf(c.options.radius));
    const bvh::RayParts parts = bvh::make_ray_parts(lanes.length, rays.radius, c.options.min_distance, rays.radius);
    answers[k].mask = brute_force_mask(c.mesh.view(), rays, c.options, c.receivers[k].excluded_primitive,
                                       c.options.min_distance > 0 ? &parts : nullptr);
    // Open at the receiver, a ray without length meets nothing.
    for (int ray = 0; ray < rays.ray_count; ++ray) {
      if (rays.ray(ray) == glm::vec3(0)) answers[k].mask.reset(ray);
    }
    const int cast = rays.cast.count();
    if (cast > 0) answers[k].occlusion = static_cast<float>(answers[k].mask.count()) / static_cast<float>(cast);
  }
  return answers;
}

// Whether an answer can be one at all.
std::string find_nonsense(const QueryCase& c, const std::string& name, const AmbientOcclusion& ao,
                          const Answers& answers) {
  for (std::size_t k = 0; k < answers.size(); ++k) {
    const OcclusionMask cast = ao.rays(c.receivers[k], c.first_index + k).cast, blocked = answers[k].mask;
    const float share = static_cast<float>(blocked.count()) / static_cast<float>(cast.count());  // NaN without rays
    if (!(blocked & ~cast).any() && equal(share, answers[k].occlusion)) continue;
    return fmt::format("{} blocks {} of {} rays that are cast, and answers {}\n{}", name, (blocked & cast).count(),
                       cast.count(), text(answers[k]), describe(c, k));
  }
  return "";
}

// Remembers the first difference.
class Comparison {
 public:
  Comparison(const QueryCase& c, const AmbientOcclusion& scalar) : case_(c), expected_(one_by_one(c, scalar)) {}

  const Answers& expected() const { return expected_; }
  const std::string& difference() const { return difference_; }

  void add(const std::string& name, const Answers& answers) {
    if (difference_.empty()) difference_ = compare(case_, name, answers, "the scalar kernel", expected_);
  }
  void add(const std::string& name, const AmbientOcclusion& ao) {
    if (!difference_.empty()) return;
    const Answers answers = one_by_one(case_, ao);
    difference_ = find_nonsense(case_, name, ao, answers);
    if (!case_.is_wild) add(name, answers);
    if (difference_.empty()) difference_ = compare(case_, name + " in a batch", as_batch(case_, ao), name, answers);
  }

 private:
  const QueryCase& case_;
  Answers expected_;
  std::string difference_;
};

// Forces nothing any more when it goes.
struct ForcedIsa {
  explicit ForcedIsa(const std::string& name) { force_isa(name); }
  ~ForcedIsa() { force_isa(""); }
  ForcedIsa(const ForcedIsa&) = delete;
  ForcedIsa& operator=(const ForcedIsa&) = delete;
};

}  // namespace

std::string find_difference(const QueryCase& c) {
  const OccluderBvh occluders(c.mesh.view(), c.build);
  const auto make_query = [&](Kernel kernel) { return AmbientOcclusion(occluders, c.pattern, c.options, kernel); };
  // The same occluders near by and farther away: the answer is that without levels.
  const auto make_levels = [&](Kernel kernel) {
    return AmbientOcclusion({{occluders, 0, c.level_end}, {occluders, c.level_end}}, c.pattern, c.options, kernel);
  };
  const AmbientOcclusion scalar = make_query(Kernel::scalar), simd = make_query(Kernel::simd);
  Comparison comparison(c, scalar);
  if (!c.is_wild) comparison.add("trying every triangle", by_brute_force(c, scalar, comparison.expected()));
  comparison.add("the scalar kernel", scalar);
  if (c.level_end > 0) comparison.add("two levels of the scalar kernel", make_levels(Kernel::scalar));
  for (const std::string& isa : available_isas()) {
    const ForcedIsa forced(isa);
    comparison.add("the SIMD kernel on " + isa, simd);
    if (c.level_end > 0) comparison.add("two levels on " + isa, make_levels(Kernel::simd));
  }
  if (c.table) comparison.add("the table kernel", AmbientOcclusion(occluders, *c.table, c.options, c.node_masks));
  return comparison.difference();
}

}  // namespace lkao::tests
