// Triangles with holes, as Python keeps them.
#include "python/holes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include "image/image.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/words.h"

namespace lkao::python {

std::shared_ptr<const scene::Holes> holes_of(const MeshHoles* holes, std::size_t triangle_count) {
  if (holes == nullptr) return nullptr;
  require(holes->holes->numbers.size() == triangle_count, "holes must be of the triangles of F");
  return holes->holes;
}

scene::AlphaImage decode_alpha(const std::string& name, std::string_view bytes, scene::AlphaOf what) {
  const image::Image image = image::decode_image(name, bytes);
  return {.width = image.width,
          .height = image.height,
          .alphas = image::alphas_of(image, what == scene::AlphaOf::alpha_or_grey)};
}

namespace {

using Corners = std::array<glm::vec2, 3>;
using Alphas = std::array<float, 3>;

// Cut-off or None, factor, number of the image or -1, (u, v) wraps, whether it is smooth.
using Material = std::tuple<std::optional<double>, double, int, std::string, std::string, bool>;

std::shared_ptr<const scene::AlphaImage> image_of(const py::array& alphas) {
  constexpr py::ssize_t kLargest = 1 << 20;
  require(alphas.ndim() == 2 && alphas.size() > 0, "an image must have the shape (height, width)");
  require(alphas.shape(0) <= kLargest && alphas.shape(1) <= kLargest, "an image must not be larger");
  const std::span<const std::uint16_t> texels = packed<std::uint16_t>(alphas);
  return std::make_shared<const scene::AlphaImage>(
      scene::AlphaImage{.width = static_cast<int>(alphas.shape(1)),
                        .height = static_cast<int>(alphas.shape(0)),
                        .alphas = {texels.begin(), texels.end()},
                        .least = *std::min_element(texels.begin(), texels.end())});
}

scene::HoleMaterial material_of(const Material& parts,
                                const std::vector<std::shared_ptr<const scene::AlphaImage>>& images) {
  const auto& [cut_off, factor, image, wrap_u, wrap_v, is_smooth] = parts;
  scene::HoleMaterial material{.cut_off = cut_off, .factor = factor};
  const scene::TextureWraps wraps{value_of(kWraps, wrap_u, "wrap"), value_of(kWraps, wrap_v, "wrap")};
  if (image < 0) return material;
  require(static_cast<std::size_t>(image) < images.size(), "there must be an image of that number");
  material.texture = scene::AlphaTexture{images[static_cast<std::size_t>(image)], wraps, is_smooth};
  return material;
}

// Of images (height, width); materials; of triangles with holes, material (k,), texture coordinates (k, 3, 2) and
// alphas (k, 3) of corners; and of all triangles which of those they are (m,).
MeshHoles make_holes(const std::vector<py::array>& images, const std::vector<Material>& materials,
                     const py::array& triangle_materials, const py::array& uvs, const py::array& alphas,
                     const py::array& numbers) {
  std::vector<std::shared_ptr<const scene::AlphaImage>> own_images;
  own_images.reserve(images.size());
  for (const py::array& image : images) own_images.push_back(image_of(image));
  scene::Holes holes;
  holes.materials.reserve(materials.size());
  for (const Material& material : materials) holes.materials.push_back(material_of(material, own_images));
  const std::span<const std::uint32_t> of_triangles = packed<std::uint32_t>(triangle_materials);
  const std::span<const Corners> corner_uvs = packed<Corners, float>(uvs);
  const std::span<const Alphas> corner_alphas = packed<Alphas, float>(alphas);
  require(corner_uvs.size() == of_triangles.size() && corner_alphas.size() == of_triangles.size(),
          "triangles with holes must have a material, texture coordinates and alphas each");
  holes.triangles.reserve(of_triangles.size());
  for (std::size_t k = 0; k < of_triangles.size(); ++k) {
    require(of_triangles[k] < materials.size(), "there must be a material of that number");
    holes.triangles.push_back({.material = of_triangles[k], .uvs = corner_uvs[k], .alphas = corner_alphas[k]});
  }
  const std::span<const std::uint32_t> of_all = packed<std::uint32_t>(numbers);
  for (const std::uint32_t number : of_all) {
    require(number == scene::kWhole || number < of_triangles.size(), "there must be holes of that number");
  }
  holes.numbers.assign(of_all.begin(), of_all.end());
  return {std::make_shared<const scene::Holes>(std::move(holes))};
}

// The number of the material's image among all; it is added where it is new.
int number_image(const scene::HoleMaterial& material, std::unordered_map<const scene::AlphaImage*, int>& known,
                 py::list& images) {
  if (!material.texture) return -1;
  const scene::AlphaImage& image = *material.texture->image;
  const auto [entry, is_new] = known.try_emplace(&image, static_cast<int>(known.size()));
  if (is_new) {
    images.append(array_of<std::uint16_t>(std::vector<std::uint16_t>(image.alphas), {image.height, image.width}));
  }
  return entry->second;
}

// What make_holes() takes.
py::tuple parts_of(const MeshHoles& from) {
  const scene::Holes& holes = *from.holes;
  std::unordered_map<const scene::AlphaImage*, int> known;
  py::list images, materials;
  for (const scene::HoleMaterial& material : holes.materials) {
    const scene::TextureWraps wraps = material.texture ? material.texture->wraps : scene::TextureWraps{};
    materials.append(py::cast(Material{material.cut_off, material.factor, number_image(material, known, images),
                                       word_of(kWraps, wraps.u), word_of(kWraps, wraps.v),
                                       !material.texture || material.texture->is_smooth}));
  }
  std::vector<std::uint32_t> of_triangles;
  std::vector<Corners> uvs;
  std::vector<Alphas> alphas;
  of_triangles.reserve(holes.triangles.size());
  uvs.reserve(holes.triangles.size());
  alphas.reserve(holes.triangles.size());
  for (const scene::HoleTriangle& triangle : holes.triangles) {
    of_triangles.push_back(triangle.material);
    uvs.push_back(triangle.uvs);
    alphas.push_back(triangle.alphas);
  }
  const auto count = static_cast<py::ssize_t>(holes.triangles.size());
  return py::make_tuple(images, materials, row_of(std::move(of_triangles)),
                        array_of<float>(std::move(uvs), {count, 3, 2}), array_of<float>(std::move(alphas), {count, 3}),
                        row_of(std::vector<std::uint32_t>(holes.numbers)));
}

}  // namespace

void bind_holes(py::module_& module) {
  py::class_<MeshHoles>(module, "Holes")
      .def_static("make", &make_holes, py::arg("images"), py::arg("materials"), py::arg("triangle_materials"),
                  py::arg("uvs"), py::arg("alphas"), py::arg("numbers"))
      .def("parts", &parts_of)
      .def("numbers", [](const MeshHoles& holes) { return row_of(std::vector<std::uint32_t>(holes.holes->numbers)); });
}

}  // namespace lkao::python
