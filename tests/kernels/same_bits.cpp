#include "same_bits.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/brute_force.h"

namespace lkao::tests {
namespace {

using Masks = std::vector<OcclusionMask>;

std::string text(const glm::vec3& v) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", v.x, v.y, v.z); }

// One line about the first receiver with another mask; empty where there is none.
std::string first_difference(const AmbientOcclusion& ao, const std::vector<Receiver>& receivers, const Masks& masks,
                             const Masks& expected) {
  for (std::size_t k = 0; k < masks.size(); ++k) {
    if (masks[k] == expected[k]) continue;
    const OcclusionMask missed = expected[k] & ~masks[k], extra = masks[k] & ~expected[k];
    int ray = 0;
    while (masks[k].test(ray) == expected[k].test(ray)) ++ray;
    return fmt::format("receiver {} of {} misses {} rays and has {} too many, ray {} of {} first: at {}, normal {}, {}",
                       k, masks.size(), missed.count(), extra.count(), ray, ao.pattern().ray_count(),
                       text(receivers[k].position), text(receivers[k].normal), text(ao.rays(receivers[k], k).ray(ray)));
  }
  return "";
}

Masks one_by_one(const AmbientOcclusion& ao, const std::vector<Receiver>& receivers) {
  Masks masks;
  for (std::size_t k = 0; k < receivers.size(); ++k) masks.push_back(ao.query(receivers[k], k).mask);
  return masks;
}

Masks in_batches(const AmbientOcclusion& ao, const std::vector<Receiver>& receivers, std::size_t batch_size) {
  const auto word_count = static_cast<std::size_t>(ao.pattern().word_count());
  Masks masks(receivers.size());
  std::vector<std::uint64_t> words;
  for (std::size_t first = 0; first < receivers.size(); first += batch_size) {
    const auto batch = std::span(receivers).subspan(first, std::min(batch_size, receivers.size() - first));
    words.assign(batch.size() * word_count, 0);
    ao.query(batch, {.mask_words = words}, first);
    for (std::size_t k = 0; k < batch.size(); ++k) {
      std::memcpy(masks[first + k].words, &words[k * word_count], word_count * sizeof(std::uint64_t));
    }
  }
  return masks;
}

// Forces nothing any more when it goes.
struct ForcedIsa {
  explicit ForcedIsa(const std::string& name) { force_isa(name); }
  ~ForcedIsa() { force_isa(""); }
  ForcedIsa(const ForcedIsa&) = delete;
  ForcedIsa& operator=(const ForcedIsa&) = delete;
};

AmbientOcclusion make_query(const Question& question, Kernel kernel) {
  return {question.levels, question.pattern, question.options, kernel};
}

void expect_equal(const Question& question, const Masks& expected) {
  const AmbientOcclusion simd = make_query(question, Kernel::simd);
  const std::vector<Receiver>& receivers = question.receivers;
  for (const std::string& isa : available_isas()) {
    const ForcedIsa forced(isa);
    EXPECT_EQ(first_difference(simd, receivers, one_by_one(simd, receivers), expected), "") << isa << ", one by one";
    for (const std::size_t batch_size : {std::size_t{1}, std::size_t{16}, receivers.size()}) {
      EXPECT_EQ(first_difference(simd, receivers, in_batches(simd, receivers, batch_size), expected), "")
          << isa << ", in batches of " << batch_size;
    }
  }
}

std::uint64_t count(const Masks& masks) {
  std::uint64_t sum = 0;
  for (const OcclusionMask& mask : masks) sum += static_cast<std::uint64_t>(mask.count());
  return sum;
}

}  // namespace

std::uint64_t expect_scalar_bits(const Question& question) {
  const Masks expected = one_by_one(make_query(question, Kernel::scalar), question.receivers);
  expect_equal(question, expected);
  return count(expected);
}

std::uint64_t expect_same_bits(const Mesh& mesh, const SamplePattern& pattern, const RayOptions& options,
                               const std::vector<Receiver>& receivers, const BuildOptions& build) {
  const Question question{{{OccluderBvh(mesh.view(), build)}}, pattern, options, receivers};
  const AmbientOcclusion scalar = make_query(question, Kernel::scalar);
  Masks expected;
  for (std::size_t k = 0; k < receivers.size(); ++k) {
    expected.push_back(
        brute_force_mask(mesh.view(), scalar.rays(receivers[k], k), options, receivers[k].excluded_primitive));
  }
  EXPECT_EQ(first_difference(scalar, receivers, one_by_one(scalar, receivers), expected), "") << "the scalar kernel";
  expect_equal(question, expected);
  return count(expected);
}

}  // namespace lkao::tests
