#include "bench/foliage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include <glm/geometric.hpp>

#include "scene/holes.h"
#include "scene/shapes.h"

namespace lkao::bench {
namespace {

using scene::Mesh;
using scene::Random;

// The share of opaque texels and its edges are those of an ellipse `leaf_count` times, one texel wide from clear to
// opaque.
scene::AlphaImage draw_leaves(int size, int leaf_count) {
  scene::AlphaImage image{.width = size, .height = size, .alphas = {}};
  image.alphas.resize(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  Random random(7);
  for (int leaf = 0; leaf < leaf_count; ++leaf) {
    const glm::dvec2 along = scene::unit_circle(random.uniform());
    const double length = size * random.uniform(0.08, 0.14), width = 0.45 * length;
    const glm::dvec2 middle(random.uniform(length, size - length), random.uniform(length, size - length));
    for (int row = 0; row < size; ++row) {
      for (int column = 0; column < size; ++column) {
        const glm::dvec2 to = glm::dvec2(column + 0.5, row + 0.5) - middle;
        const glm::dvec2 at(glm::dot(to, along) / length, (to.y * along.x - to.x * along.y) / width);
        const double alpha = std::clamp(width * (1 - glm::length(at)) + 0.5, 0.0, 1.0);
        std::uint16_t& texel = image.alphas[static_cast<std::size_t>(row * size + column)];
        texel = std::max(texel, static_cast<std::uint16_t>(257 * static_cast<int>(255 * alpha)));
      }
    }
  }
  image.least = *std::min_element(image.alphas.begin(), image.alphas.end());
  return image;
}

// A mesh of which some quads are cards.
class Plants {
 public:
  Plants() {
    holes_.materials.push_back(
        {.cut_off = 0.5,
         .texture = scene::AlphaTexture{std::make_shared<const scene::AlphaImage>(draw_leaves(512, 40))}});
  }

  Mesh& whole() { return mesh_; }

  // Shows the whole image.
  void add_card(const glm::dvec3& middle, const glm::dvec3& across, const glm::dvec3& up) {
    holes_.numbers.resize(mesh_.triangles.size(), scene::kWhole);
    scene::add_quad(mesh_, middle - across - up, middle + across - up, middle + across + up, middle - across + up);
    const std::array<glm::vec2, 4> uvs = {glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0), glm::vec2(0, 0)};
    for (const std::array<std::size_t, 3>& corners : {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 3}}) {
      holes_.numbers.push_back(static_cast<std::uint32_t>(holes_.triangles.size()));
      holes_.triangles.push_back({.uvs = {uvs[corners[0]], uvs[corners[1]], uvs[corners[2]]}});
    }
  }

  Mesh take() {
    holes_.numbers.resize(mesh_.triangles.size(), scene::kWhole);
    mesh_.holes = std::make_shared<const scene::Holes>(std::move(holes_));
    return std::move(mesh_);
  }

 private:
  Mesh mesh_;
  scene::Holes holes_;
};

void add_ground(Plants& plants, double half) {
  scene::add_quad(plants.whole(), {-half, 0, half}, {half, 0, half}, {half, 0, -half}, {-half, 0, -half});
}

Mesh make_card() {
  Plants plants;
  add_ground(plants, 4);
  plants.add_card({0, 1, 0}, {4, 0, 0}, {0, 0, 4});
  return plants.take();
}

Mesh make_grass() {
  Plants plants;
  add_ground(plants, 10);
  Random random(3);
  for (int tuft = 0; tuft < 8000; ++tuft) {
    const double x = random.uniform(-10, 10), z = random.uniform(-10, 10), turn = random.uniform(), size = 0.25;
    for (int card = 0; card < 3; ++card) {
      const glm::dvec2 across = size * scene::unit_circle(turn + card / 6.0);
      plants.add_card({x, 0.8 * size, z}, {across.x, 0, across.y}, {0, 0.8 * size, 0});
    }
  }
  return plants.take();
}

// Around a trunk, 7 high.
void add_tree(Plants& plants, Random& random, const glm::dvec3& base) {
  const glm::dvec2 trunk[] = {{0.3, 0}, {0.2, 2}, {0.08, 6}, {0, 6.5}};
  scene::add_revolved(plants.whole(), base, trunk, 16);
  for (int card = 0; card < 600; ++card) {
    const glm::dvec3 out = random.unit_vector(), along = random.unit_vector();
    const glm::dvec3 middle =
        base + glm::dvec3(0, 4.5, 0) + glm::dvec3(2.2, 2.5, 2.2) * std::cbrt(random.uniform()) * out;
    plants.add_card(middle, 0.4 * glm::normalize(glm::cross(out, along)), 0.4 * along);
  }
}

Mesh make_trees() {
  Plants plants;
  add_ground(plants, 16);
  Random random(5);
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 5; ++column) {
      add_tree(plants, random,
               {5.0 * (column - 2) + random.uniform(-1, 1), 0, 5.0 * (row - 2) + random.uniform(-1, 1)});
    }
  }
  return plants.take();
}

}  // namespace

const std::vector<std::string>& foliage_names() {
  static const std::vector<std::string> kNames = {"card", "grass", "trees"};
  return kNames;
}

StudyScene make_foliage(const std::string& name, int width, int height) {
  const glm::vec3 up(0, 1, 0);
  if (name == "card") return look_at(name, make_card(), {8}, {{0, 0.9f, 3.9f}, {0, 0, 0}, up, 60}, width, height);
  if (name == "grass") return look_at(name, make_grass(), {1}, {{0, 2, 6}, {0, 0, 2}, up, 60}, width, height);
  return look_at(name, make_trees(), {2, 8}, {{0, 5, 16}, {0, 3.5f, 0}, up, 60}, width, height);
}

}  // namespace lkao::bench
