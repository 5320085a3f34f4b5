#include "check.h"

#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "oracle.h"
#include "rivals.h"
#include "support/sanitized.h"

namespace lkao::tests {
namespace {

// Rays that a method answers differently from the oracle.
struct Differences {
  std::uint64_t missed_count = 0;  // blocked says the oracle, open says the method
  std::uint64_t extra_count = 0;   // the other way round

  void add(const OcclusionMask& mask, const OcclusionMask& exact) {
    missed_count += static_cast<std::uint64_t>((exact & ~mask).count());
    extra_count += static_cast<std::uint64_t>((mask & ~exact).count());
  }
};

class Check {
 public:
  explicit Check(const HardCase& hard_case)
      : case_(hard_case),
        occluders_(hard_case.mesh.view()),
        table_(hard_case.pattern, {.resolution = 32}),
        rivals_(make_rivals(hard_case.mesh)),
        of_rivals_(rivals_.size()) {
    // Where they judge areas by rounded numbers, they may call more of them zero, never fewer.
    const Oracle oracle(case_.mesh.view(), Sidedness::two_sided);
    EXPECT_GE(occluders_.report().zero_area_count, oracle.zero_area_count());
  }

  void run() {
    for (const ReceiverGroup& group : case_.groups) {
      const Oracle oracle(case_.mesh.view(), group.options.sidedness);
      const AmbientOcclusion ao(occluders_, case_.pattern, group.options);
      expect_equal_kernels(group);
      for (std::size_t k = 0; k < group.receivers.size(); ++k) compare(oracle, ao, group.receivers[k], k);
    }
  }

  void report(const std::string& name) const {
    std::string heading = fmt::format("{:>36} {:>9} {:>9} | lkao missed, extra, farthest", "case", "rays", "blocked");
    std::string row = fmt::format("{:>36} {:>9} {:>9} | {:>11}, {:>5}, {:>8.1e}", name, ray_count_, blocked_count_,
                                  ours_.missed_count, ours_.extra_count, farthest_);
    for (std::size_t i = 0; i < rivals_.size(); ++i) {
      const std::string cell = fmt::format(" | {} missed, extra", rivals_[i].name);
      heading += cell;
      const Differences& differences = of_rivals_[i];
      row += fmt::format(" | {:>{}}, {:>5}", differences.missed_count, cell.size() - 10, differences.extra_count);
    }
    fmt::print("{}\n{}\n", heading, row);
    testing::Test::RecordProperty("differences", row);
  }

  std::uint64_t ray_count() const { return ray_count_; }
  std::uint64_t blocked_count() const { return blocked_count_; }

 private:
  void expect_equal_kernels(const ReceiverGroup& group) const {
    const RayOptions& options = group.options;
    const AmbientOcclusion simd(occluders_, case_.pattern, options);
    const AmbientOcclusion looked_up(occluders_, table_, options);
    const AmbientOcclusion scalar(occluders_, case_.pattern, options, Kernel::scalar);
    std::vector<OcclusionMask> expected;
    for (std::size_t k = 0; k < group.receivers.size(); ++k) {
      expected.push_back(scalar.query(group.receivers[k], k).mask);
    }
    const auto expect_equal = [&](const AmbientOcclusion& ao, const std::string& name) {
      for (std::size_t k = 0; k < group.receivers.size(); ++k) {
        EXPECT_EQ(ao.query(group.receivers[k], k).mask, expected[k])
            << name << ", radius " << options.radius << ", receiver " << k;
      }
    };
    expect_equal(simd, "simd");
    expect_equal(looked_up, "table");
    for (const std::string& isa : available_isas()) {
      force_isa(isa);
      expect_equal(simd, isa);
    }
    force_isa("");
  }

  void compare(const Oracle& oracle, const AmbientOcclusion& ao, const Receiver& receiver, std::size_t index) {
    const ReceiverRays rays = ao.rays(receiver, index);
    const OcclusionMask exact = oracle.blocked(rays, receiver.excluded_primitive);
    const OcclusionMask mask = ao.query(receiver, index).mask;
    ray_count_ += static_cast<std::uint64_t>(rays.cast.count());
    blocked_count_ += static_cast<std::uint64_t>(exact.count());
    ours_.add(mask, exact);
    for (int i = 0; i < rays.ray_count; ++i) {
      if (mask.test(i) == exact.test(i)) continue;
      const double distance = exact.test(i) ? oracle.distance_from_plane(rays, i, receiver.excluded_primitive)
                                            : oracle.distance_from_blocked(rays, i, receiver.excluded_primitive);
      farthest_ = std::max(farthest_, distance);
      EXPECT_LE(distance, case_.rounding_distance)
          << "radius " << ao.options().radius << ", receiver " << index << ", ray " << i
          << (exact.test(i) ? " is missed" : " is blocked by nothing");
    }
    for (std::size_t i = 0; i < rivals_.size(); ++i) of_rivals_[i].add(rivals_[i].mask(ao, receiver, index), exact);
  }

  const HardCase& case_;
  OccluderBvh occluders_;
  PlaneMaskTable table_;
  std::vector<Rival> rivals_;
  std::vector<Differences> of_rivals_;
  Differences ours_;
  std::uint64_t ray_count_ = 0;
  std::uint64_t blocked_count_ = 0;
  double farthest_ = 0;  // of the differences of the library
};

}  // namespace

void check(const std::string& name, const HardCase& hard_case) {
  Check all(hard_case);
  all.run();
  all.report(name);
  // There is something to disagree about.
  EXPECT_GT(all.ray_count(), unless_sanitized(5'000u, 1'000u));
  EXPECT_GT(all.blocked_count(), all.ray_count() / 100);
}

}  // namespace lkao::tests
