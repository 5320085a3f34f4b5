#include "scene/holes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include <glm/common.hpp>

#include "lut/random.h"
#include "scene/hole_survey.h"

namespace lkao::scene {

namespace {

// The texel that an image of `count` texels shows at the place of texel `i` of the endless plane, `i` an integer.
int wrapped(double i, int count, TextureWrap wrap) {
  const double size = count;
  if (wrap == TextureWrap::clamp) return static_cast<int>(std::clamp(i, 0.0, size - 1));
  const double period = wrap == TextureWrap::mirror ? 2 * size : size;
  const double k = std::clamp(i - period * std::floor(i / period), 0.0, period - 1);
  return static_cast<int>(k < size ? k : period - 1 - k);
}

// The texels around a place on one axis, and the share of the second.
struct Neighbours {
  int first, second;
  double share;
};

Neighbours neighbours(double t, int count, TextureWrap wrap) {
  const double i = t * count - 0.5;
  if (i >= 0 && i < count - 1) {  // inside, as most places are, all ways of wrapping are the same
    const int number = static_cast<int>(i);
    return {number, number + 1, i - number};
  }
  const double first = std::floor(i);
  return {wrapped(first, count, wrap), wrapped(first + 1, count, wrap), i - first};
}

std::uint16_t texel(const AlphaImage& image, int x, int y) {
  const std::size_t i =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
  return image.alphas[i];
}

double alpha_of(std::uint16_t texel) { return texel / 65535.0; }

// From [0, 1).
double lot_of(std::size_t triangle, const glm::vec2& place) {
  const std::uint64_t bits =
      std::uint64_t{std::bit_cast<std::uint32_t>(place.x)} << 32 | std::bit_cast<std::uint32_t>(place.y);
  lut::RandomStream random(lut::mix_bits(bits) ^ triangle);
  return random.next_double();
}

}  // namespace

double AlphaTexture::at(const glm::dvec2& uv) const {
  if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return 1;
  if (!is_smooth) {
    return alpha_of(texel(*image, wrapped(std::floor(uv.x * image->width), image->width, wraps.u),
                          wrapped(std::floor(uv.y * image->height), image->height, wraps.v)));
  }
  const Neighbours x = neighbours(uv.x, image->width, wraps.u), y = neighbours(uv.y, image->height, wraps.v);
  const std::uint16_t a = texel(*image, x.first, y.first), b = texel(*image, x.second, y.first),
                      c = texel(*image, x.first, y.second), d = texel(*image, x.second, y.second);
  if (a == b && a == c && a == d) return alpha_of(a);
  const double upper = std::lerp(alpha_of(a), alpha_of(b), x.share);
  const double lower = std::lerp(alpha_of(c), alpha_of(d), x.share);
  return std::lerp(upper, lower, y.share);
}

void HoleTriangle::turn_round() {
  std::swap(uvs[1], uvs[2]);
  std::swap(alphas[1], alphas[2]);
}

void Holes::append(const Holes& part) {
  const auto first_material = static_cast<std::uint32_t>(materials.size());
  const auto first = static_cast<std::uint32_t>(triangles.size());
  materials.insert(materials.end(), part.materials.begin(), part.materials.end());
  triangles.reserve(triangles.size() + part.triangles.size());
  for (HoleTriangle triangle : part.triangles) {
    triangle.material += first_material;
    triangles.push_back(triangle);
  }
  numbers.reserve(numbers.size() + part.numbers.size());
  for (const std::uint32_t number : part.numbers) numbers.push_back(number == kWhole ? kWhole : number + first);
}

void Holes::add(const Holes& other, std::size_t triangle) {
  const std::uint32_t number = other.numbers[triangle];
  numbers.push_back(number == kWhole ? kWhole : static_cast<std::uint32_t>(triangles.size()));
  if (number != kWhole) triangles.push_back(other.triangles[number]);
}

bool AlphaTexture::is_at_least(double alpha, const glm::dvec2& lower, const glm::dvec2& upper) const {
  constexpr double kMostTexels = 4096, kFarthest = 1e9;  // beyond, numbers of texels are coarse
  if (image->least / 65535.0 >= alpha) return true;
  // One texel more on each side: smooth images show it, and so does what rounding puts beyond the box.
  const glm::dvec2 size(image->width, image->height);
  const glm::dvec2 first = glm::floor(lower * size) - 1.0, last = glm::floor(upper * size) + 1.0;
  const glm::dvec2 count = last - first + 1.0;
  const glm::dvec2 far = glm::max(glm::abs(first), glm::abs(last));
  if (!(count.x * count.y <= kMostTexels && far.x < kFarthest && far.y < kFarthest)) return false;
  for (double y = first.y; y <= last.y; ++y) {
    for (double x = first.x; x <= last.x; ++x) {
      const int column = wrapped(x, image->width, wraps.u), row = wrapped(y, image->height, wraps.v);
      if (alpha_of(texel(*image, column, row)) < alpha) return false;
    }
  }
  return true;
}

double Holes::alpha(std::size_t triangle, const glm::dvec2& place) const {
  const std::uint32_t number = numbers[triangle];
  if (number == kWhole) return 1;
  const HoleTriangle& holes = triangles[number];
  const HoleMaterial& material = materials[holes.material];
  double alpha = material.factor * mix_corners(holes.alphas, place, static_cast<double>(holes.alphas[0]));
  if (material.texture) alpha *= material.texture->at(mix_corners(holes.uvs, place, glm::dvec2(holes.uvs[0])));
  return std::isnan(alpha) ? 1 : std::clamp(alpha, 0.0, 1.0);
}

bool Holes::blocks(std::size_t triangle, const glm::vec2& place) const {
  const std::uint32_t number = numbers[triangle];
  if (number == kWhole) return true;
  const std::optional<double>& cut_off = materials[triangles[number].material].cut_off;
  const double there = alpha(triangle, glm::dvec2(place));
  return cut_off ? there >= *cut_off : lot_of(triangle, place) < there;
}

bool Holes::is_seen(std::size_t triangle, const glm::dvec2& place) const {
  constexpr double kHalf = 0.5;
  const std::uint32_t number = numbers[triangle];
  if (number == kWhole) return true;
  return alpha(triangle, place) >= materials[triangles[number].material].cut_off.value_or(kHalf);
}

CutOuts cut_outs_of(const std::shared_ptr<const Holes>& holes) {
  if (!holes) return {};
  CutOuts cut_outs;
  cut_outs.opacities.reserve(holes->numbers.size());
  for (const std::uint32_t number : holes->numbers) cut_outs.opacities.push_back(number == kWhole ? 1.0f : 0.0f);
  cut_outs.blocks = [holes](std::uint32_t, std::uint32_t primitive, float u, float v) {
    return holes->blocks(primitive, {u, v});
  };
  cut_outs.survey = HoleSurvey(holes);
  cut_outs.looks = looks_of(*holes);
  return cut_outs;
}

}  // namespace lkao::scene
