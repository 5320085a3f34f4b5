// Polygons in the plane, cut into triangles by clipping one ear after another.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "scene/formats/point_tree.h"

namespace lkao::scene {

// An ear is a corner whose neighbours see each other inside the polygon. In a simple polygon a corner that is no ear
// becomes one only when a neighbour goes, so each corner is looked at again just then. Corners at the same place
// (holes that a bridge joins to the outline), straight corners and spikes are understood. Where a polygon cuts itself
// there may be no ear, and made to that end a large one could take hours to look through: then any corner is clipped.
class EarClipper {
 public:
  // Adds n - 2 triangles of a polygon that runs counterclockwise and has n >= 3 finite corners.
  void clip(std::span<const glm::dvec2> polygon, std::vector<glm::uvec3>& triangles);

 private:
  // Which corners may go, tried in this order. An open ear is one but for what touches its border.
  enum Rule { kSpike, kEar, kFlat, kOpenEar, kAny, kRuleCount };

  struct Candidate {
    std::uint32_t corner;
    std::uint32_t version;
  };

  // First in, first out: triangles do not gather around one corner.
  struct Queue {
    std::vector<Candidate> candidates;
    std::size_t first = 0;
  };

  void link(std::span<const glm::dvec2> polygon);
  void refresh(std::uint32_t corner);
  void push(std::uint32_t corner, Rule rule) { queues_[rule].candidates.push_back({corner, versions_[corner]}); }
  std::uint32_t take(Rule& rule);
  bool may_clip(std::uint32_t corner, Rule rule);
  bool is_ear(std::uint32_t corner);
  bool is_open_ear(std::uint32_t corner);
  bool enters(std::uint32_t other, std::uint32_t corner) const;

  const glm::dvec2& before(std::uint32_t corner) const { return polygon_[previous_[corner]]; }
  const glm::dvec2& after(std::uint32_t corner) const { return polygon_[next_[corner]]; }

  std::span<const glm::dvec2> polygon_;
  std::vector<std::uint32_t> previous_, next_;
  std::vector<std::uint32_t> versions_;  // another one whenever a neighbour goes
  std::array<Queue, kRuleCount> queues_;
  PointTree tree_;  // marked: corners that are not convex, the only ones that can lie in an ear
  std::size_t work_limit_ = 0;
};

}  // namespace lkao::scene
