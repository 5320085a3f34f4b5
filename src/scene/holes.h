// Triangles with holes by transparency: leaves, fences, hair. Images say where; rays are asked one by one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

#include "lkao/cut_outs.h"
#include "scene/contents.h"

namespace lkao::scene {

// What an image says of transparency, row by row from the top: 0 is clear, 65535 opaque. Alphas of 8 and of 16 bits are
// kept exactly.
struct AlphaImage {
  int width = 0, height = 0;
  std::vector<std::uint16_t> alphas;
  std::uint16_t least = 0;  // of all of them, or less

  // Above 0, as are width and height of an image that anything is asked of.
  std::size_t size() const { return alphas.size(); }
};

// What is taken from an image: its alpha, of which one without is opaque everywhere; or, of one without, how bright it
// is, as in images that show nothing but opacity.
enum class AlphaOf { alpha, alpha_or_grey };

// Makes it of the bytes of an image file, PNG, JPEG or WebP; `name` is for messages. Throws std::runtime_error with one
// line where that cannot be done.
using DecodeAlpha = std::function<AlphaImage(const std::string& name, std::string_view bytes, AlphaOf what)>;

// An image as a material shows it.
struct AlphaTexture {
  std::shared_ptr<const AlphaImage> image;
  TextureWraps wraps = {};
  bool is_smooth = true;  // linear between the middles of texels; otherwise a texel has one alpha

  // At texture coordinates as of Mesh::uvs, from 0 to 1; 1 where they are not finite.
  double at(const glm::dvec2& uv) const;
  // Whether no texel is less that a place in this box may show. Where that is too much to look at, the whole image is
  // asked.
  bool is_at_least(double alpha, const glm::dvec2& lower, const glm::dvec2& upper) const;
};

// How the alpha of a material is made, and what it means.
struct HoleMaterial {
  // Opaque where alpha is no less, and not there where it is. None: half-transparent, so that a ray is blocked with the
  // probability alpha.
  std::optional<double> cut_off = {};
  double factor = 1;  // of the texture, and of the corners' own alphas
  std::optional<AlphaTexture> texture = {};
};

struct HoleTriangle {
  std::uint32_t material = 0;               // in Holes::materials
  std::array<glm::vec2, 3> uvs = {};        // where its corners are on the material's image
  std::array<float, 3> alphas = {1, 1, 1};  // their own

  // As the triangle whose second and third corner change places.
  void turn_round();
};

// At a place of a triangle with such values at its corners, of which `first` is that of the first; where they are
// equal, exactly that.
template <typename Value, typename Wide>
Wide mix_corners(const std::array<Value, 3>& corners, const glm::dvec2& place, const Wide& first) {
  return first + place.x * (Wide(corners[1]) - first) + place.y * (Wide(corners[2]) - first);
}

inline constexpr std::uint32_t kWhole = 0xffffffffu;

// Of all triangles of a mesh. Points are (1 - u - v) a + u b + v c of a triangle's corners.
struct Holes {
  std::vector<HoleMaterial> materials;
  std::vector<HoleTriangle> triangles;
  std::vector<std::uint32_t> numbers;  // of each triangle of the mesh: which of these it is, or kWhole

  // Adds those of the triangles behind.
  void append(const Holes& part);
  // Adds that of one triangle of a mesh with the same materials.
  void add(const Holes& other, std::size_t triangle);

  // From 0 to 1; 1 for whole triangles, and where numbers that are not finite leave none.
  double alpha(std::size_t triangle, const glm::dvec2& place) const;
  // Whether a ray that meets the triangle there is blocked. What is half-transparent draws lots by the place and the
  // triangle alone: rays that meet it elsewhere get another answer, the same ray the same on any thread and method.
  bool blocks(std::size_t triangle, const glm::vec2& place) const;
  // Whether eyes see it: what is half-transparent from an alpha of a half on.
  bool is_seen(std::size_t triangle, const glm::dvec2& place) const;
};

// For BuildOptions: none where `holes` is null. They share it.
CutOuts cut_outs_of(const std::shared_ptr<const Holes>& holes);

}  // namespace lkao::scene
