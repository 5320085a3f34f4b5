#include "bench/deformations.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lut/coordinates.h"
#include "lut/random.h"

namespace lkao::bench {
namespace {

constexpr float kTurn = 2 * std::numbers::pi_v<float>;

// The frame of a mesh: its longest side and the two others, in right-handed order.
struct Frame {
  explicit Frame(std::span<const glm::vec3> positions) {
    glm::vec3 lower(std::numeric_limits<float>::max()), upper(-lower);
    for (const glm::vec3& p : positions) {
      if (!lut::is_in_range(p)) continue;
      lower = glm::min(lower, p);
      upper = glm::max(upper, p);
    }
    middle = 0.5f * (lower + upper);
    const glm::vec3 size = upper - lower;
    diagonal = glm::length(size);
    for (int axis = 1; axis < 3; ++axis) {
      if (size[axis] > size[along]) along = axis;
    }
    length = size[along];
  }

  glm::vec3 middle;
  float diagonal, length;
  int along = 0;
};

glm::vec3 twisted(const glm::vec3& p, const Frame& frame, float turns) {
  const int u = (frame.along + 1) % 3, v = (frame.along + 2) % 3;
  glm::vec3 result = p - frame.middle;
  const float angle = kTurn * turns * result[frame.along] / frame.length;
  const float sine = std::sin(angle), cosine = std::cos(angle);
  const float x = result[u], y = result[v];
  result[u] = cosine * x - sine * y;
  result[v] = sine * x + cosine * y;
  return frame.middle + result;
}

glm::vec3 bent(const glm::vec3& p, const Frame& frame, float turns) {
  const int u = (frame.along + 1) % 3;
  const float radius = frame.length / (kTurn * turns);
  glm::vec3 result = p - frame.middle;
  const float angle = result[frame.along] / radius, from_center = radius + result[u];
  result[frame.along] = from_center * std::sin(angle);
  result[u] = from_center * std::cos(angle) - radius;
  return frame.middle + result;
}

glm::vec3 shaken(const glm::vec3& p, const Frame& frame, float share, lut::RandomStream& random) {
  const auto coordinate = [&] { return static_cast<float>(2 * random.next_double() - 1) * share * frame.diagonal; };
  const float x = coordinate(), y = coordinate();
  return p + glm::vec3(x, y, coordinate());
}

}  // namespace

std::span<const float> deformation_strengths(Deformation deformation) {
  static constexpr float kTurns[] = {0.05f, 0.2f, 0.5f, 1.0f};
  static constexpr float kShares[] = {1e-4f, 1e-3f, 3e-3f, 1e-2f};
  return deformation == Deformation::shake ? std::span(kShares) : std::span(kTurns);
}

std::vector<glm::vec3> deform(std::span<const glm::vec3> positions, Deformation deformation, float strength) {
  const Frame frame(positions);
  lut::RandomStream random(0);
  std::vector<glm::vec3> moved(positions.size());
  std::transform(positions.begin(), positions.end(), moved.begin(), [&](const glm::vec3& p) {
    switch (deformation) {
      case Deformation::twist:
        return twisted(p, frame, strength);
      case Deformation::bend:
        return bent(p, frame, strength);
      default:
        return shaken(p, frame, strength, random);
    }
  });
  return moved;
}

}  // namespace lkao::bench
