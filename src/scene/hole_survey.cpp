#include "scene/hole_survey.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <glm/common.hpp>

namespace lkao::scene {

namespace {

// The share of the triangle that the square stands for, by the values of its corners: what is linear lies between them.
struct SquareBounds {
  bool is_known = true;     // all are finite
  AlphaRange own;           // of factor and corners' own alphas
  glm::dvec2 lower, upper;  // texture coordinates
};

SquareBounds bounds_of(const HoleTriangle& triangle, double factor, float u0, float v0, float size) {
  constexpr double kFar = std::numeric_limits<double>::max();
  SquareBounds bounds{true, {kFar, -kFar}, glm::dvec2(kFar), glm::dvec2(-kFar)};
  const double u = double{u0}, v = double{v0}, width = double{size};
  for (const glm::dvec2& corner :
       {glm::dvec2(u, v), glm::dvec2(u + width, v), glm::dvec2(u, v + width), glm::dvec2(u + width, v + width)}) {
    const double alpha = factor * mix_corners(triangle.alphas, corner, double{triangle.alphas[0]});
    const glm::dvec2 uv = mix_corners(triangle.uvs, corner, glm::dvec2(triangle.uvs[0]));
    bounds.is_known = bounds.is_known && std::isfinite(alpha) && std::isfinite(uv.x) && std::isfinite(uv.y);
    bounds.own = {std::min(bounds.own.least, alpha), std::max(bounds.own.most, alpha)};
    bounds.lower = glm::min(bounds.lower, uv);
    bounds.upper = glm::max(bounds.upper, uv);
  }
  // Where corners are alike, so is all between them, to the last bit.
  if (bounds.own.least != bounds.own.most) {
    const double rounding = 1e-12 * std::max(std::fabs(bounds.own.least), std::fabs(bounds.own.most));
    bounds.own = {bounds.own.least - rounding, bounds.own.most + rounding};
  }
  return bounds;
}

}  // namespace

HoleSurvey::HoleSurvey(std::shared_ptr<const Holes> holes) : holes_(std::move(holes)) {
  std::unordered_map<const AlphaImage*, std::shared_ptr<const TexelBounds>> known;
  images_.reserve(holes_->materials.size());
  for (const HoleMaterial& material : holes_->materials) {
    images_.emplace_back();
    if (!material.texture) continue;
    std::shared_ptr<const TexelBounds>& bounds = known[material.texture->image.get()];
    if (!bounds) bounds = std::make_shared<const TexelBounds>(material.texture->image);
    images_.back() = bounds;
  }
}

CutOutPart HoleSurvey::operator()(std::uint32_t triangle, float u0, float v0, float size) const {
  const std::uint32_t number = holes_->numbers[triangle];
  if (number == kWhole) return CutOutPart::opaque;
  const HoleTriangle& holes = holes_->triangles[number];
  const HoleMaterial& material = holes_->materials[holes.material];
  const SquareBounds square = bounds_of(holes, material.factor, u0, v0, size);
  if (!square.is_known || square.own.least < 0) return CutOutPart::mixed;
  AlphaRange alpha = square.own;
  if (material.texture) {
    const AlphaRange shown = images_[holes.material]->of(*material.texture, square.lower, square.upper);
    alpha = {alpha.least * shown.least, alpha.most * shown.most};
  }
  // As Holes::blocks: half-transparent is what is neither 0 nor 1.
  if (std::min(alpha.least, 1.0) >= material.cut_off.value_or(1)) return CutOutPart::opaque;
  const bool is_clear = material.cut_off ? std::min(alpha.most, 1.0) < *material.cut_off : alpha.most == 0;
  return is_clear ? CutOutPart::clear : CutOutPart::mixed;
}

std::vector<std::uint32_t> looks_of(const Holes& holes) {
  static_assert(sizeof(HoleTriangle) == sizeof(std::uint32_t) * (1 + 6 + 3), "all of its bytes are looked at");
  std::unordered_map<std::string_view, std::uint32_t> known;
  std::vector<std::uint32_t> numbers;
  numbers.reserve(holes.triangles.size());
  for (const HoleTriangle& triangle : holes.triangles) {
    const std::string_view bytes(reinterpret_cast<const char*>(&triangle), sizeof(triangle));
    numbers.push_back(known.try_emplace(bytes, static_cast<std::uint32_t>(known.size())).first->second);
  }
  std::vector<std::uint32_t> looks;
  looks.reserve(holes.numbers.size());
  for (const std::uint32_t number : holes.numbers) looks.push_back(number == kWhole ? kWhole : numbers[number]);
  return looks;
}

}  // namespace lkao::scene
