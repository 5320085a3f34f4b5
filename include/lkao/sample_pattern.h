// Sample patterns: which shadow rays a receiver casts.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010,
// Eq. 3 (shadow rays with stochastic lengths) and Sec. 6 (two-step Lloyd relaxation). lut/README.md compares the kinds.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "lkao/export.h"
#include "lkao/pattern_kind.h"
#include "lkao/requirements.h"
#include "lkao/weighting.h"

namespace lkao {

// A pattern has from kMinRayCount to kMaxRayCount rays.
inline constexpr int kMinRayCount = 1;
inline constexpr int kMaxRayCount = 1024;

// True from kMinRayCount to kMaxRayCount.
constexpr bool is_valid_ray_count(int ray_count) { return ray_count >= kMinRayCount && ray_count <= kMaxRayCount; }

// 64-bit words of a mask of so many rays. Bits of the last word beyond them are never set.
constexpr int word_count_of(int ray_count) { return (ray_count + 63) / 64; }

// How much an occluder at distance x (as a share of the AO radius) darkens: rho(x) of Eq. 1.
// 1 = as much as a touching occluder, 0 = not at all. A falloff never rises with distance.
class LKAO_API Falloff {
 public:
  using Function = std::function<double(double)>;

  // rho(x) = 1 up to the radius. All rays are as long as the AO radius.
  static Falloff constant();
  // rho(x) = 1 - x.
  static Falloff linear();
  // rho(x) = 1 - 3x^2 + 2x^3 (flat at both ends).
  static Falloff smooth();
  // rho(x) = (exp(-rate x) - exp(-rate)) / (1 - exp(-rate)), which reaches 0 at the radius.
  // Throws std::invalid_argument unless 0 < rate <= 100.
  static Falloff exponential(double rate = 4.0);
  // Any function of x in [0, 1] with values in [0, 1] that never rises. It is sampled at 4097 places;
  // throws std::invalid_argument, naming the place, where a sample is out of range or rises.
  static Falloff custom(std::string name, Function rho);
  // One of the above by its name: "constant", "linear", "smooth", "exponential".
  // Throws std::invalid_argument naming the unknown name and the known ones.
  static Falloff named(const std::string& name);

  double operator()(double x) const { return rho_(x); }
  const std::string& name() const { return name_; }

  // The largest x in [0, 1] with rho(x) >= u: the length of a ray whose share of longer rays is u, so
  // that P(length >= x) = rho(x) for uniform u. Found by bisection, exact to 1e-12.
  double length_at(double u) const;

 private:
  Falloff(std::string name, Function rho);
  std::string name_;
  Function rho_;
};

// By its name above. Throws std::invalid_argument naming the unknown name and the known ones.
LKAO_API PatternKind pattern_kind_named(const std::string& name);
LKAO_API const char* pattern_kind_name(PatternKind kind);

// An immutable set of shadow rays around +z: ray i = direction(i) x length(i), with the AO radius as
// unit of length. Directions are as dense as their weighting says, usually that of the cosine (points spread evenly
// over the unit disk, lifted), so occlusion is a plain mean over rays (Eq. 3). Neighbouring indices are neighbouring
// directions (sorted along a Hilbert curve), which keeps bit masks coherent.
//
// Copies share their storage; every member may be called from any thread.
class LKAO_API SamplePattern {
 public:
  // Same arguments, same pattern. Cost for 1024 rays: some tenth of a second for `lloyd` and `paper`, as much again for
  // a falloff that is not constant; milliseconds for 128. Any count is as good as its neighbours; the time of a query
  // grows with it, more slowly than in proportion.
  //
  // One ray alone points halfway up, at 45 degrees, where the elevations below and above weigh the same (`paper`:
  // straight up; evenly weighted, at 30 degrees): turned from receiver to receiver, it sees walls, of which one along
  // the normal knows nothing.
  // Throws std::invalid_argument for a ray count out of range.
  static SamplePattern make(PatternKind kind, int ray_count, const Falloff& falloff = Falloff::constant(),
                            std::uint64_t seed = 0, Weighting weighting = Weighting::cosine);

  // make(PatternKind::lloyd, ...).
  static SamplePattern relaxed(int ray_count, const Falloff& falloff = Falloff::constant(), std::uint64_t seed = 0,
                               Weighting weighting = Weighting::cosine);

  // The pattern `relaxed` of that count and weighting, of seed 0 and constant falloff, made at the first call for each
  // and kept for the life of the process.
  static const SamplePattern& standard(int ray_count, Weighting weighting = Weighting::cosine);

  // A pattern of the caller's own: points inside the unit disk (|p| < 1) and lengths in [0, 1], one each. Point p is
  // the direction (p, sqrt(1 - |p|^2)), so the density of the points is the caller's weighting: even for that of the
  // cosine; evenly spread points times sqrt(2 - |p|^2) for directions even by solid angle; for any other density of z,
  // radii sqrt(1 - z^2). Kept in the given order. Throws std::invalid_argument naming the first bad ray.
  static SamplePattern from_disk(std::span<const glm::vec2> points, std::span<const float> lengths);

  // The same directions, with ray lengths distributed after another falloff. Lengths are stratified, one in each
  // of ray_count equal shares, jointly with directions: every region of the hemisphere, and every ring of
  // elevations, gets its part of short and long rays, by the pattern's weighting (that of the cosine for from_disk).
  // Which ray gets which share is found at the first call (some ten milliseconds for 1024 rays) and kept with the
  // directions.
  SamplePattern with_falloff(const Falloff& falloff) const;

  int ray_count() const;
  // 64-bit words of a mask of this pattern.
  int word_count() const { return word_count_of(ray_count()); }
  // Points on the unit disk, one per ray.
  std::span<const glm::vec2> disk() const;
  // Unit directions with z > 0: (x, y, sqrt(1 - x^2 - y^2)).
  std::span<const glm::vec3> directions() const;
  // Lengths in [0, 1]; the longest is the AO radius.
  std::span<const float> lengths() const;
  // Elevation of the lowest ray above the horizon, in radians; > 0. No tilt below it hides a ray. About sqrt(1 / (2 n))
  // for n rays of the default, and 1 / (2 n) of its even weighting, whose lowest ring leaves as good as no room for
  // Jitter::tilt.
  float lowest_elevation() const;

 private:
  struct Directions;
  static SamplePattern from_points(std::span<const glm::vec2> points, std::span<const float> lengths,
                                   Weighting weighting);
  SamplePattern(std::shared_ptr<const Directions> directions, std::vector<float> lengths);
  std::shared_ptr<const Directions> directions_;
  std::shared_ptr<const std::vector<float>> lengths_;
};

}  // namespace lkao
