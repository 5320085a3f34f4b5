#include "gpu/horizon_definition.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace lkao::gl::tests {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSectorCount = 32;

double golden_share(int i) { return std::fmod(i * (std::numbers::phi - 1), 1.0); }

// GLSL's v += v.yzx * v.zxy.
using Three = std::array<std::uint32_t, 3>;
Three stirred(const Three& v) { return {v[0] + v[1] * v[2], v[1] + v[2] * v[0], v[2] + v[0] * v[1]}; }

// pcg3d of Jarzynski and Olano.
Three hash(Three v) {
  for (std::uint32_t& x : v) x = x * 1664525u + 1013904223u;
  v = stirred(v);
  for (std::uint32_t& x : v) x ^= x >> 16u;
  return stirred(v);
}

// The cell of a Hilbert curve of 64 x 64, quadrant by quadrant.
std::uint32_t hilbert_index(std::uint32_t x, std::uint32_t y, std::uint32_t side = 64) {
  if (side == 1) return 0;
  const std::uint32_t half = side / 2, right = x / half, top = y / half;
  x %= half, y %= half;
  const std::uint32_t before = (right == 0 ? top : 3 - top) * half * half;
  if (top == 1) return before + hilbert_index(x, y, half);
  return before + (right == 0 ? hilbert_index(y, x, half) : hilbert_index(half - 1 - y, half - 1 - x, half));
}

double share_of(std::uint32_t bits) { return (bits >> 8u) * 0x1p-24; }

// The fraction of a multiple, as the pass has it in 32 bits.
double fraction(std::uint32_t index, std::uint32_t step, std::uint32_t seed, std::uint32_t seed_step) {
  return share_of(index * step + seed * seed_step);
}

double slice_density_at(double azimuth, double c) {
  const double across = std::sqrt(1 - c * c) * std::cos(azimuth);
  const double turn = std::atan2(across, c), length = std::hypot(across, c);
  return length * (slice_measure(turn + kPi / 2, turn) - slice_measure(turn - kPi / 2, turn));
}

}  // namespace

double slice_measure(double angle, double turn) {
  const double x = std::fabs(angle), mirrored = angle < 0 ? -turn : turn;
  // cos(x - turn) sin(x) = (sin(2 x - turn) + sin(turn)) / 2, mirrored where the angle is.
  const double sum = (std::cos(mirrored) - std::cos(2 * x - mirrored)) / 4 + x * std::sin(mirrored) / 2;
  return angle < 0 ? -sum : sum;
}

double slice_azimuth(double share, double c) {
  const double s = std::sqrt(1 - c * c);
  double low = -kPi / 2, high = kPi / 2;
  for (int i = 0; i < 60; ++i) {
    const double x = 0.5 * (low + high);
    const double below =
        std::atan2(c * std::sin(x), std::cos(x)) + s * std::sin(x) * std::atan2(s * std::cos(x), c) + kPi / 2;
    (below < share * kPi ? low : high) = x;
  }
  return low;
}

struct HorizonDefinition::Receiver {
  std::size_t index;
  glm::dvec3 position, normal, up, to_eye, side, other;
};

struct HorizonDefinition::Slice {
  glm::dvec3 along;
  double turn, length, up_turn, lower, upper, density;
  glm::dvec2 step;
  double step_width;
  double cast() const { return slice_measure(upper, turn) - slice_measure(lower, turn); }
};

HorizonDefinition::HorizonDefinition(const PixelView& view, const HorizonOptions& options)
    : options_(options),
      clip_from_view_(view.camera().projection),
      is_perspective_(view.camera().projection[2][3] != 0),
      width_(view.width()),
      height_(view.height()) {
  const glm::dmat4 view_from_world(view.camera().view);
  const glm::dmat3 turn(view_from_world);
  for (const SeenPixel& seen : view.pixels()) {
    const glm::dvec3 position(view_from_world * glm::dvec4(glm::dvec3(glm::vec3(seen.position)), 1));
    pixels_.push_back({position, turn * seen.normal, turn * seen.geometric_normal, seen.is_there()});
  }
}

HorizonDefinition::Receiver HorizonDefinition::receiver_of(std::size_t index) const {
  const Pixel& pixel = pixels_[index];
  Receiver receiver{index, pixel.position, glm::normalize(pixel.normal), glm::normalize(pixel.up), {}, {}, {}};
  receiver.to_eye = is_perspective_ ? -glm::normalize(pixel.position) : glm::dvec3(0, 0, 1);
  const double facing = glm::dot(receiver.up, receiver.to_eye);
  if (facing < 1e-4) receiver.up = glm::normalize(receiver.up + (1e-4 - facing) * receiver.to_eye);
  const auto across = [&](const glm::dvec3& v) { return v - glm::dot(v, receiver.to_eye) * receiver.to_eye; };
  glm::dvec3 side = across(receiver.normal);
  if (glm::dot(side, side) < 1e-8) {
    side = across(std::fabs(receiver.to_eye.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
  }
  receiver.side = glm::normalize(side);
  receiver.other = glm::cross(receiver.to_eye, receiver.side);
  return receiver;
}

glm::dvec2 HorizonDefinition::place_of(const glm::dvec3& position) const {
  const glm::dvec4 clip = clip_from_view_ * glm::dvec4(position, 1);
  return (0.5 * glm::dvec2(clip) / clip.w + 0.5) * glm::dvec2(width_, height_);
}

HorizonDefinition::Slice HorizonDefinition::slice_of(const Receiver& receiver, double share) const {
  const double c = std::fmax(glm::dot(receiver.normal, receiver.to_eye), 0.05);
  const bool is_even = options_.slice_density == SliceDensity::even;
  const double azimuth = is_even ? kPi * (share - 0.5) : slice_azimuth(share, std::fmin(c, 1.0));
  Slice slice{};
  slice.density = is_even ? 1 : slice_density_at(azimuth, std::fmin(c, 1.0));
  slice.along = std::cos(azimuth) * receiver.side + std::sin(azimuth) * receiver.other;
  const glm::dvec2 normal(glm::dot(receiver.normal, receiver.to_eye), glm::dot(receiver.normal, slice.along));
  slice.turn = std::atan2(normal.y, normal.x);
  slice.length = glm::length(normal);
  slice.up_turn = std::atan2(glm::dot(receiver.up, slice.along), glm::dot(receiver.up, receiver.to_eye));
  slice.lower = std::fmax(slice.turn, slice.up_turn) - kPi / 2;
  slice.upper = std::fmin(slice.turn, slice.up_turn) + kPi / 2;
  const double small = 1e-6 * glm::length(receiver.position);
  const glm::dvec2 move =
      (place_of(receiver.position + small * slice.along) - place_of(receiver.position - small * slice.along)) /
      (2 * small);
  slice.step_width = 1 / std::fmax(std::fabs(move.x), std::fabs(move.y));
  slice.step = slice.step_width * move;
  return slice;
}

// The ray that touches the ball, and where it is on the screen.
double HorizonDefinition::end_of(const Receiver& receiver, const Slice& slice, double side) const {
  const double farthest = options_.screen_radius / glm::length(slice.step);
  if (!is_perspective_) return std::fmin(options_.radius / slice.step_width, farthest);
  const double sine = options_.radius / glm::length(receiver.position);
  if (sine >= 1) return farthest;
  const glm::dvec3 ray = std::sqrt(1 - sine * sine) * -receiver.to_eye + side * sine * slice.along;
  if (ray.z >= 0) return farthest;
  const glm::dvec2 off = place_of(ray) - place_of(receiver.position);
  return std::fmin(std::fmax(std::fabs(off.x), std::fabs(off.y)), farthest);
}

double HorizonDefinition::elevation(const Receiver& receiver, const glm::dvec3& to) const {
  const double forward = glm::dot(to, receiver.to_eye) / glm::length(to);
  const glm::dvec3 across = glm::normalize(to / glm::length(to) - forward * receiver.to_eye);
  const double horizon = std::atan2(glm::dot(receiver.up, across), glm::dot(receiver.up, receiver.to_eye)) + kPi / 2;
  const double elevation = horizon - std::acos(std::clamp(forward, -1.0, 1.0)), bias = options_.angle_bias;
  return elevation > bias ? std::sqrt(elevation * elevation - bias * bias) : 0;
}

double HorizonDefinition::falloff(double away) const {
  if (options_.falloff_begin >= 1) return 1;
  return std::clamp((1 - away / options_.radius) / (1.0 - options_.falloff_begin), 0.0, 1.0);
}

double HorizonDefinition::weight(const Slice& slice) const {
  if (slice.lower >= slice.upper) return 0;
  const bool are_angles =
      options_.estimator == HorizonEstimator::bitmask && options_.sector_measure == SectorMeasure::angle;
  return (are_angles ? 1 : slice.length * slice.cast()) / slice.density;
}

template <typename Visit>
void HorizonDefinition::walk(const Receiver& receiver, const Slice& slice, double side, double move, int step_count,
                             const Visit& visit) const {
  const int x = static_cast<int>(receiver.index) % width_, y = static_cast<int>(receiver.index) / width_;
  const double end = end_of(receiver, slice, side);
  for (int i = 0; i < step_count; ++i) {
    const double share = std::pow((i + move) / step_count, options_.step_exponent);
    const double place = std::fmax(i + 1, std::floor(end * share + 0.5));
    const int to_x = x + static_cast<int>(std::floor(side * place * slice.step.x + 0.5));
    const int to_y = y + static_cast<int>(std::floor(side * place * slice.step.y + 0.5));
    if (place > end || to_x < 0 || to_y < 0 || to_x >= width_ || to_y >= height_) return;
    const Pixel& pixel = pixels_[static_cast<std::size_t>(to_y * width_ + to_x)];
    visit(pixel.is_there ? &pixel : nullptr, place);
  }
}

double HorizonDefinition::horizon(const Receiver& receiver, const Slice& slice, double side, const Moves& moves,
                                  int step_count) const {
  double highest = 0, last = 0;
  walk(receiver, slice, side, moves.step, step_count, [&](const Pixel* pixel, double place) {
    double found = 0;
    if (pixel != nullptr) {
      const glm::dvec3 to = pixel->position - receiver.position;
      const double away = glm::length(to);
      if (away < options_.radius) found = elevation(receiver, to) * falloff(away);
    }
    const double kept = std::exp(-(place - last) * slice.step_width / options_.thickness);
    highest = found >= highest ? found : found + (highest - found) * kept;
    last = place;
  });
  return highest;
}

std::uint32_t HorizonDefinition::sectors(const Receiver& receiver, const Slice& slice, double side, const Moves& moves,
                                         int step_count) const {
  const bool are_angles = options_.sector_measure == SectorMeasure::angle;
  const auto below = [&](double angle) {
    const double x = std::clamp(angle, slice.lower, slice.upper);
    const double share = are_angles
                             ? (x - slice.lower) / (slice.upper - slice.lower)
                             : (slice_measure(x, slice.turn) - slice_measure(slice.lower, slice.turn)) / slice.cast();
    return static_cast<int>(std::floor(kSectorCount * share + moves.sector));
  };
  std::uint32_t blocked = 0;
  walk(receiver, slice, side, moves.step, step_count, [&](const Pixel* pixel, double) {
    if (pixel == nullptr) return;
    const glm::dvec3 to = pixel->position - receiver.position;
    const double away = glm::length(to), front = away < options_.radius ? elevation(receiver, to) : 0;
    if (front == 0) return;
    // The back: as far along the pixel's ray as the ball and the thickness let it.
    const glm::dvec3 ray = is_perspective_ ? glm::normalize(pixel->position) : glm::dvec3(0, 0, -1);
    double low = 0, high = std::fmin(options_.thickness, 2.0 * options_.radius);
    const auto is_in_ball = [&](double depth) { return glm::length(to + depth * ray) <= options_.radius; };
    if (is_in_ball(high)) low = high;
    for (int i = 0; i < 50; ++i) (is_in_ball(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
    const double back = std::fmin(elevation(receiver, to + low * ray), front);
    const double tangent = kPi / 2 + side * slice.up_turn;
    const double near = std::fmax(tangent - front, 0.0), far = tangent - back;
    const int first = side > 0 ? below(near) : below(-far), last = side > 0 ? below(far) : below(-near);
    const int reaching = static_cast<int>(std::floor(kSectorCount * falloff(away) + moves.reach));
    for (int i = first; i < std::min(last, kSectorCount); ++i) {
      // Sector i is the longer the earlier its number, turned and with its five bits backwards, comes.
      unsigned number = (static_cast<unsigned>(i) + kSectorCount - moves.turn) % kSectorCount, rank = 0;
      for (int bit = 0; bit < 5; ++bit, number >>= 1u) rank = 2 * rank + (number & 1u);
      if (static_cast<int>(rank) < reaching) blocked |= 1u << static_cast<unsigned>(i);
    }
  });
  return blocked;
}

double HorizonDefinition::occlusion(const Receiver& receiver, const Slice& slice, const Moves& moves,
                                    int step_count) const {
  if (options_.estimator == HorizonEstimator::bitmask) {
    return std::popcount(sectors(receiver, slice, 1, moves, step_count) |
                         sectors(receiver, slice, -1, moves, step_count)) /
           double{kSectorCount};
  }
  const double above = kPi / 2 + slice.up_turn - horizon(receiver, slice, 1, moves, step_count);
  const double beneath = kPi / 2 - slice.up_turn - horizon(receiver, slice, -1, moves, step_count);
  const double upper = std::clamp(std::fmax(above, 0), slice.lower, slice.upper);
  const double lower = std::clamp(-std::fmax(beneath, 0), slice.lower, slice.upper);
  return 1 - (slice_measure(upper, slice.turn) - slice_measure(lower, slice.turn)) / slice.cast();
}

double HorizonDefinition::of(std::size_t index) const {
  const Receiver receiver = receiver_of(index);
  const auto x = static_cast<std::uint32_t>(index) % static_cast<std::uint32_t>(width_);
  const auto y = static_cast<std::uint32_t>(index) / static_cast<std::uint32_t>(width_);
  const std::uint32_t place = hilbert_index(x % 64, y % 64), seed = options_.seed;
  double sum = 0, weight_sum = 0;
  for (int i = 0; i < options_.slice_count; ++i) {
    const double share = (i + fraction(place, 3242174889u, seed, 2654435769u)) / options_.slice_count;
    const Slice slice = slice_of(receiver, share);
    const Three random = hash({x, y, seed * 512u + static_cast<std::uint32_t>(i)});
    const double step = std::fmod(fraction(place, 2447445414u, seed, 1779033704u) + golden_share(i), 1.0);
    const Moves moves{step, share_of(random[0]), share_of(random[1]), random[2] >> 27u};
    if (weight(slice) == 0) continue;
    sum += weight(slice) * occlusion(receiver, slice, moves, options_.step_count);
    weight_sum += weight(slice);
  }
  return weight_sum > 0 ? sum / weight_sum : 0;
}

double HorizonDefinition::converged(std::size_t index, int slice_count) const {
  const Receiver receiver = receiver_of(index);
  double sum = 0, weight_sum = 0;
  for (int i = 0; i < slice_count; ++i) {
    const Slice slice = slice_of(receiver, (i + 0.5) / slice_count);
    const Moves moves{0.5, golden_share(i), golden_share(3 * i + 1), static_cast<unsigned>(i) % 32u};
    if (weight(slice) == 0) continue;
    sum += weight(slice) * occlusion(receiver, slice, moves, std::max(width_, height_));
    weight_sum += weight(slice);
  }
  return weight_sum > 0 ? sum / weight_sum : 0;
}

}  // namespace lkao::gl::tests
