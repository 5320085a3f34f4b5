// What the horizon pass finds, once more, in double precision and by other formulas where there are any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "gpu/pixel_view.h"
#include "lkao/gl/horizon_pass.h"

namespace lkao::gl::tests {

// The integral of cos(x - turn) |sin(x)| from 0 to `angle`.
double slice_measure(double angle, double turn);

// Where a slice lies that has `share` of all slices below it: its angle from the plane of the normal and the direction
// to the eye, between which the angle is that of the cosine `c`; by halving.
double slice_azimuth(double share, double c);

class HorizonDefinition {
 public:
  HorizonDefinition(const PixelView& view, const HorizonOptions& options);

  // Of a pixel with a receiver, by the pass's own slices.
  double of(std::size_t index) const;
  // By so many slices, on which each pixel is stepped.
  double converged(std::size_t index, int slice_count) const;

 private:
  struct Pixel {
    glm::dvec3 position, normal, up;  // in view space
    bool is_there;
  };
  struct Receiver;
  struct Slice;
  // What is random of a slice.
  struct Moves {
    double step, sector, reach;
    unsigned turn;
  };

  Receiver receiver_of(std::size_t index) const;
  Slice slice_of(const Receiver& receiver, double share) const;
  double end_of(const Receiver& receiver, const Slice& slice, double side) const;
  glm::dvec2 place_of(const glm::dvec3& position) const;
  double elevation(const Receiver& receiver, const glm::dvec3& to) const;
  double falloff(double away) const;
  double weight(const Slice& slice) const;
  double occlusion(const Receiver& receiver, const Slice& slice, const Moves& moves, int step_count) const;
  double horizon(const Receiver& receiver, const Slice& slice, double side, const Moves& moves, int step_count) const;
  std::uint32_t sectors(const Receiver& receiver, const Slice& slice, double side, const Moves& moves,
                        int step_count) const;
  // Calls visit(pixel, place) for each step; null where it shows nothing.
  template <typename Visit>
  void walk(const Receiver& receiver, const Slice& slice, double side, double move, int step_count,
            const Visit& visit) const;

  HorizonOptions options_;
  glm::dmat4 clip_from_view_;
  bool is_perspective_;
  int width_, height_;
  std::vector<Pixel> pixels_;
};

}  // namespace lkao::gl::tests
