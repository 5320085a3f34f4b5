#include "bake/texel_coverage.h"

#include <cmath>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "bake/texture_meshes.h"
#include "lut/random.h"

namespace lkao::bake {
namespace {

// All tiles of a map.
std::vector<TileCoverage> cover_all(const Mesh& mesh, const TextureOptions& options) {
  const CornerNormals normals(mesh, NormalSource::facet);
  const TextureLayout layout(normals, options);
  const TextureCharts charts = find_charts(layout);
  std::vector<TileCoverage> tiles;
  for (int y = 0; y < options.height; y += kTileSize) {
    for (int x = 0; x < options.width; x += kTileSize) {
      const glm::ivec2 size(std::min(kTileSize, options.width - x), std::min(kTileSize, options.height - y));
      tiles.push_back(cover_tile(layout, charts, {0, {x, y}, size}, layout.placements(0, y, y + size.y)));
    }
  }
  return tiles;
}

std::size_t overlapping_texels(const Mesh& mesh, const TextureOptions& options) {
  std::size_t count = 0;
  for (const TileCoverage& tile : cover_all(mesh, options)) count += tile.overlapping_texel_count;
  return count;
}

// By texel of the map, row by row: its area, and how many pieces it is in.
struct Covered {
  double area = 0;
  int count = 0;
};
std::map<int, Covered> covered_texels(const Mesh& mesh, const TextureOptions& options) {
  std::map<int, Covered> texels;
  for (const TileCoverage& tile : cover_all(mesh, options)) {
    for (const TexelPiece& piece : tile.pieces) {
      const glm::ivec2 place = tile.tile.first + texel_place(piece.texel);
      EXPECT_LT(std::max(place.x - options.width, place.y - options.height), 0);
      Covered& covered = texels[place.y * options.width + place.x];
      covered.area += piece.area;
      ++covered.count;
    }
  }
  return texels;
}

Mesh uv_triangle(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  Mesh mesh;
  add_uv_triangle(mesh, {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}}, {glm::vec2(a), glm::vec2(b), glm::vec2(c)});
  return mesh;
}

TEST(TexelCoverage, TexelsAreNumberedOnce) {
  std::vector<bool> is_seen(std::size_t{kTileSize} * kTileSize);
  for (int y = 0; y < kTileSize; ++y) {
    for (int x = 0; x < kTileSize; ++x) {
      const std::uint32_t number = texel_number({x, y});
      ASSERT_LT(number, is_seen.size());
      EXPECT_FALSE(is_seen[number]);
      is_seen[number] = true;
      EXPECT_EQ(texel_place(number), glm::ivec2(x, y));
    }
  }
}

TEST(TexelCoverage, AreasAddUpToTheTriangle) {
  const TextureOptions options{.width = 300, .height = 150};
  lut::RandomStream random(5);
  const auto point = [&random] { return glm::dvec2(random.next_double(), random.next_double()); };
  for (int i = 0; i < 20; ++i) {
    const glm::dvec2 a = point();
    // Large ones, small ones, needles.
    const double size = i % 3 == 0 ? 1 : 0.02, width = i % 4 == 0 ? 1e-3 : 1;
    const glm::dvec2 b = glm::mix(a, point(), size), c = glm::mix(a, glm::mix(b, point(), width), size);
    const Mesh mesh = uv_triangle(a, b, c);
    const glm::dvec2 to_b = glm::dvec2(mesh.uvs[1]) - glm::dvec2(mesh.uvs[0]);
    const glm::dvec2 to_c = glm::dvec2(mesh.uvs[2]) - glm::dvec2(mesh.uvs[0]);
    double sum = 0;
    for (const auto& [texel, covered] : covered_texels(mesh, options)) sum += covered.area;
    EXPECT_NEAR(sum, 0.5 * 300 * 150 * std::abs(to_b.x * to_c.y - to_b.y * to_c.x), 1e-6);
  }
}

// Every texel in which a point of the triangle lies, and its area by counting points.
TEST(TexelCoverage, AgreesWithPointsAllOver) {
  const TextureOptions options{.width = 16, .height = 16};
  const glm::dvec2 a(0.7, 1.3), b(14.2, 3.1), c(5.5, 13.9);
  const std::map<int, Covered> covered = covered_texels(uv_triangle(a / 16.0, b / 16.0, c / 16.0), options);
  constexpr int kSide = 32;
  const auto side_of = [](const glm::dvec2& from, const glm::dvec2& to, const glm::dvec2& p) {
    return (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
  };
  std::size_t touched_count = 0;
  for (int texel = 0; texel < 16 * 16; ++texel) {
    int count = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
      const glm::dvec2 p = glm::dvec2(texel % 16, texel / 16) + (glm::dvec2(i % kSide, i / kSide) + 0.5) / 32.0;
      count += side_of(a, b, p) > 0 && side_of(b, c, p) > 0 && side_of(c, a, p) > 0;
    }
    touched_count += count > 0;
    if (count > 0) {
      ASSERT_TRUE(covered.contains(texel)) << texel;
    }
    if (covered.contains(texel)) {
      EXPECT_NEAR(covered.at(texel).area, count / 1024.0, 0.04) << texel;
    }
  }
  EXPECT_GE(covered.size(), touched_count);
  EXPECT_GT(touched_count, 80u);
}

// The two triangles of each square, and the squares, share edges: none of them wants the other's texels.
TEST(TexelCoverage, NeighboursDoNotOverlap) {
  Mesh mesh;
  for (int i = 0; i < 49; ++i) {
    const glm::vec2 first = glm::vec2(i % 7, i / 7) / 7.0f, end = glm::vec2(i % 7 + 1, i / 7 + 1) / 7.0f;
    add_uv_quad(mesh, {{i, 0, 0}, {i, 0, 1}, {i + 1, 0, 1}, {i + 1, 0, 0}}, {first, end});
  }
  const TextureOptions options{.width = 60, .height = 60};
  EXPECT_EQ(overlapping_texels(mesh, options), 0u);
  const std::map<int, Covered> covered = covered_texels(mesh, options);
  EXPECT_EQ(covered.size(), 3600u);
  for (const auto& [texel, of_texel] : covered) EXPECT_NEAR(of_texel.area, 1, 1e-4) << texel;
}

// Two charts that want the same texels: the first one in the file has them, whole, and nothing is lost beside them.
TEST(TexelCoverage, TheFirstChartHasTheTexel) {
  Mesh mesh;
  add_uv_quad(mesh, {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, {{0.25f, 0.25f}, {0.75f, 0.75f}});
  add_uv_quad(mesh, {{5, 0, 0}, {5, 0, 1}, {6, 0, 1}, {6, 0, 0}}, {{0.5f, 0.25f}, {1, 0.75f}});
  const TextureOptions options{.width = 32, .height = 32};
  EXPECT_EQ(overlapping_texels(mesh, options), 8u * 16u);
  const std::map<int, Covered> covered = covered_texels(mesh, options);
  EXPECT_EQ(covered.size(), 24u * 16u);
  for (const auto& [texel, of_texel] : covered) EXPECT_NEAR(of_texel.area, 1, 1e-9) << texel;
}

// Halves of a symmetric model on the same texels: joined in space and in the texture, along the mirror.
TEST(TexelCoverage, AFoldOverlaps) {
  Mesh mesh;
  add_uv_quad(mesh, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 0}, {0.5f, 0.5f}});
  add_uv_quad(mesh, {{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {-1, 1, 0}}, {{0.5f, 0}, {0, 0.5f}});
  EXPECT_EQ(overlapping_texels(mesh, {.width = 32, .height = 32}), 256u);
}

// Many triangles in each texel, twice over each other.
TEST(TexelCoverage, SmallTrianglesOverlap) {
  Mesh mesh;
  for (int layer = 0; layer < 2; ++layer) {
    for (int i = 0; i < 1600; ++i) {
      const glm::vec2 first = glm::vec2(i % 40, i / 40) / 40.0f, end = glm::vec2(i % 40 + 1, i / 40 + 1) / 40.0f;
      const float x = static_cast<float>(i % 40), z = static_cast<float>(i / 40), y = static_cast<float>(layer);
      add_uv_quad(mesh, {{x, y, z}, {x, y, z + 1}, {x + 1, y, z + 1}, {x + 1, y, z}}, {first, end});
    }
  }
  const TextureOptions options{.width = 2, .height = 2};
  EXPECT_EQ(overlapping_texels(mesh, options), 4u);
  for (const auto& [texel, of_texel] : covered_texels(mesh, options)) EXPECT_NEAR(of_texel.area, 1, 0.01) << texel;
}

}  // namespace
}  // namespace lkao::bake
