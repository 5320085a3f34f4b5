#include "bake/texture.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>
#include <glm/geometric.hpp>

#include "bake/edge_clearance.h"
#include "bake/texel_receivers.h"
#include "bake/texture_meshes.h"
#include "support/sanitized.h"

namespace lkao::bake {
namespace {

// What a receiver sees of a rectangle through its whole cosine-weighted half space: parallel to it at height c, or in
// an upright plane at distance c, with a corner straight above; it reaches b to the side and a away.
double parallel_share(double a, double b, double c) {
  const auto half = [](double x, double y) { return x / std::hypot(1, x) * std::atan(y / std::hypot(1, x)); };
  return (half(a / c, b / c) + half(b / c, a / c)) / (2 * std::numbers::pi);
}
double upright_share(double a, double b, double c) {
  return (std::atan(b / c) - c / std::hypot(a, c) * std::atan(b / std::hypot(a, c))) / (2 * std::numbers::pi);
}

// Mean and worst of what texels differ from an answer for their middles.
template <class Answer>
void expect_near(const TextureMap& map, const UvBox& box, double worst, double mean, const Answer& answer) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const glm::dvec2 uv((x + 0.5) / map.width, (y + 0.5) / map.height);
      const glm::dvec2 share = (uv - glm::dvec2(box.upper_left)) / glm::dvec2(box.lower_right - box.upper_left);
      if (std::min(share.x, share.y) < 0 || std::max(share.x, share.y) > 1) continue;
      const double error = static_cast<double>(map.occlusion[map.texel(x, y)]) - answer(share);
      EXPECT_LE(std::abs(error), worst) << "texel " << x << ", " << y;
      sum += error;
      ++count;
    }
  }
  EXPECT_GT(count, 0);
  EXPECT_LE(std::abs(sum / count), mean);
}

// A floor of 1 x 1 before a wall of height 1 that ends, to the sides, nowhere in sight.
Mesh floor_and_wall() {
  Mesh mesh;
  add_uv_quad(mesh, {{0, 0, 1}, {1, 0, 1}, {1, 0, 0}, {0, 0, 0}}, {{0, 0}, {1, 1}});
  add_bare_quad(mesh, {{-50, 0, 0}, {50, 0, 0}, {50, 1, 0}, {-50, 1, 0}});
  return mesh;
}

TEST(Texture, AFloorBeforeAWallHasTheClosedForm) {
  const TextureBake baked = bake_map(floor_and_wall(), {.width = 64, .height = 64}, 256, NormalSource::facet, 1e5f);
  EXPECT_EQ(baked.report.covered_texel_count, 64u * 64u);
  EXPECT_EQ(baked.report.overlapping_texel_count, 0u);
  expect_near(baked.maps[0], {{0, 0}, {1, 1}}, 0.02, 0.001, [](const glm::dvec2& share) {
    const double height = 1 / share.y;  // over distance; the upper edge of the map is the foot of the wall
    return 0.5 * (1 - 1 / std::sqrt(1 + height * height));
  });
}

TEST(Texture, SoItHasAtTheUsualSize) {
  const int size = tests::unless_sanitized(1024, 32);
  const TextureBake baked =
      bake_map(floor_and_wall(), {.width = size, .height = size, .edge_grid = 1}, 32, NormalSource::facet, 1e5f);
  expect_near(baked.maps[0], {{0, 0}, {1, 1}}, 0.1, 0.002, [](const glm::dvec2& share) {
    const double height = 1 / share.y;
    return 0.5 * (1 - 1 / std::sqrt(1 + height * height));
  });
}

// Corners, edges, and what fills the gaps.
TEST(Texture, AClosedRoomIsWhollyDark) {
  for (const glm::vec3& shift : {glm::vec3(0), glm::vec3(100, -200, 50)}) {
    for (const float gap : {0.0f, 0.02f}) {
      Mesh mesh = uv_room({3, 2, 5}, gap);
      for (glm::vec3& p : mesh.positions) p += shift;
      const TextureBake baked = bake_map(mesh, {.width = 64, .height = 64}, 64);
      for (const float value : baked.maps[0].occlusion) EXPECT_EQ(value, 1);
    }
  }
}

TEST(Texture, AnOpenBoxHasTheClosedForm) {
  const float w = 3, h = 2, d = 5;
  const TextureMap map = bake_map(uv_room({w, h, d}, 0.02f, false), {.width = 96, .height = 64}).maps[0];
  const auto box = [](int number) {
    const glm::vec2 cell(1.0f / 3, 0.5f), first = cell * glm::vec2(number % 3, number / 3);
    return UvBox{first + 0.02f, first + cell - 0.02f};
  };
  // The floor: u is z, v upwards is x.
  expect_near(map, box(0), 0.04, 0.003, [&](const glm::dvec2& share) {
    const double z = d * share.x, x = w * (1 - share.y);
    return 1 - parallel_share(x, z, h) - parallel_share(w - x, z, h) - parallel_share(x, d - z, h) -
           parallel_share(w - x, d - z, h);
  });
  // The wall z = 0: u is x, v upwards is y.
  expect_near(map, box(1), 0.04, 0.003, [&](const glm::dvec2& share) {
    const double x = w * share.x, y = h * (1 - share.y);
    return 1 - upright_share(d, x, h - y) - upright_share(d, w - x, h - y);
  });
}

// The value of a texel that lies wholly in one triangle is that of the query, bit for bit.
TEST(Texture, IsWhatTheQueryAnswers) {
  const Mesh mesh = floor_and_wall();
  const AmbientOcclusion ao = query_of(mesh, 64);
  const CornerNormals normals(mesh, NormalSource::facet);
  const TextureOptions options{.width = 160, .height = 32, .level_seams = false};
  const TextureMap map = bake_texture(normals, scene::bounds_of(mesh), options, ask_of(ao)).maps[0];

  const TextureLayout layout(normals, options);
  const TextureCharts charts = find_charts(layout);
  std::size_t compared = 0;
  for (const std::uint64_t tile : {0u, 1u}) {
    const glm::ivec2 first(128 * static_cast<int>(tile), 0), size(tile == 0 ? 128 : 32, 32);
    const TileCoverage coverage = cover_tile(layout, charts, {0, first, size}, layout.placements(0, 0, 32));
    const TexelReceivers made = make_receivers(layout, coverage, edge_clearance(scene::bounds_of(mesh)), nullptr);
    for (std::uint64_t i = 0; i < made.receivers.size(); ++i) {
      if (made.weights[i] < 1) continue;
      const glm::ivec2 place = first + texel_place(made.texels[i]);
      EXPECT_EQ(map.occlusion[map.texel(place.x, place.y)], ao.query(made.receivers[i], (tile << 32) + i).occlusion);
      ++compared;
    }
  }
  EXPECT_GT(compared, 4000u);
}

bool is_same(const TextureMap& a, const TextureMap& b) {
  const auto is_same_bits = [](float x, float y) {
    return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
  };
  return a.coverage == b.coverage &&
         std::equal(a.occlusion.begin(), a.occlusion.end(), b.occlusion.begin(), is_same_bits);
}

TEST(Texture, PartsAndThreadsMakeTheSameBits) {
  const Mesh mesh = uv_room({3, 2, 5}, 0.01f, false);
  const AmbientOcclusion ao = query_of(mesh, 64);
  const CornerNormals normals(mesh, NormalSource::facet);
  const Bounds bounds = scene::bounds_of(mesh);
  const TextureOptions options{.width = 200, .height = 140};
  const TextureBake whole = bake_texels(normals, bounds, options, ask_of(ao));

  TextureBake single;
  tbb::task_arena(1).execute([&] { single = bake_texels(normals, bounds, options, ask_of(ao)); });
  EXPECT_TRUE(is_same(whole.maps[0], single.maps[0]));

  // One receiver at a time.
  const Ask one_by_one = [&](std::span<const Receiver> receivers, const QueryOutputs& outputs, std::uint64_t first) {
    for (std::size_t i = 0; i < receivers.size(); ++i)
      outputs.occlusion[i] = ao.query(receivers[i], first + i).occlusion;
  };
  EXPECT_TRUE(is_same(whole.maps[0], bake_texels(normals, bounds, options, one_by_one).maps[0]));

  TextureMap joined_map;
  std::size_t receiver_count = 0;
  for (std::size_t part = 0; part < 3; ++part) {
    const TextureBake share = bake_texels(normals, bounds, options, ask_of(ao), {part, 3});
    receiver_count += share.report.receiver_count;
    if (part == 0) joined_map = share.maps[0];
    for (std::size_t i = 0; i < joined_map.size(); ++i) {
      if (share.maps[0].coverage[i] == 0) continue;
      joined_map.coverage[i] = share.maps[0].coverage[i];
      joined_map.occlusion[i] = share.maps[0].occlusion[i];
    }
  }
  EXPECT_EQ(receiver_count, whole.report.receiver_count);
  EXPECT_TRUE(is_same(whole.maps[0], joined_map));
}

TEST(Texture, RefusesAPartOfNothing) {
  const Mesh mesh = floor_and_wall();
  const CornerNormals normals(mesh, NormalSource::facet);
  const Ask none = [](std::span<const Receiver>, const QueryOutputs&, std::uint64_t) {};
  EXPECT_THROW(bake_texels(normals, scene::bounds_of(mesh), {}, none, {0, 0}), std::invalid_argument);
  EXPECT_THROW(bake_texels(normals, scene::bounds_of(mesh), {}, none, {2, 2}), std::invalid_argument);
}

TEST(Texture, CanBeWatchedAndStopped) {
  const Mesh mesh = floor_and_wall();
  const CornerNormals normals(mesh, NormalSource::facet);
  const TextureOptions options{.width = 256, .height = 200};
  std::size_t asked_count = 0;
  const Ask dark = [&asked_count](std::span<const Receiver> receivers, const QueryOutputs& outputs, std::uint64_t) {
    std::fill(outputs.occlusion.begin(), outputs.occlusion.end(), 1.0f);
    asked_count += receivers.size();
  };
  std::vector<std::size_t> steps;
  const TextureBake baked =
      bake_texels(normals, scene::bounds_of(mesh), options, dark, {}, [&](std::size_t done, std::size_t total) {
        EXPECT_EQ(total, 256u * 200u);
        steps.push_back(done);
        return true;
      });
  EXPECT_EQ(steps, (std::vector<std::size_t>{0, 128 * 128, 256 * 128, 256 * 128 + 128 * 72, 256 * 200}));
  EXPECT_EQ(baked.report.receiver_count, asked_count);
  EXPECT_EQ(baked.report.texel_count, 256u * 200u);
  for (const std::size_t last : {0u, 128u * 128u}) {
    const auto stop = [last](std::size_t done, std::size_t) { return done < last; };
    EXPECT_THROW(bake_texels(normals, scene::bounds_of(mesh), options, dark, {}, stop), Cancelled) << last;
  }
}

TEST(Texture, FinishingTellsItsStepsAndCanBeStopped) {
  Mesh mesh;
  add_uv_quad(mesh, {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, {{0, 0}, {0.5f, 1}});
  const CornerNormals normals(mesh, NormalSource::facet);
  const TextureOptions options{.width = 16, .height = 16};
  const Bounds bounds = scene::bounds_of(mesh);
  const Ask dark = [](std::span<const Receiver> receivers, const QueryOutputs& outputs, std::uint64_t) {
    std::fill_n(outputs.occlusion.begin(), receivers.size(), 1.0f);
  };
  for (const std::size_t last : {1u, 2u, 3u, 4u}) {
    TextureBake bake = bake_texels(normals, bounds, options, dark);
    std::vector<std::size_t> steps;
    const auto stop = [&](std::size_t done, std::size_t total) {
      EXPECT_EQ(total, 4u);
      steps.push_back(done);
      return done < last;
    };
    EXPECT_THROW(finish_texture(normals, options, bake, stop), Cancelled);
    EXPECT_EQ(steps.size(), last);
  }

  // A whole bake is told that all texels are there, and stops then.
  std::size_t times = 0;
  const auto stop = [&](std::size_t done, std::size_t total) {
    EXPECT_EQ(total, 256u);
    return done < total || ++times < 3;
  };
  EXPECT_THROW(bake_texture(normals, bounds, options, dark, stop), Cancelled);
}

// Samples of a texel that half of lies in a chart count by their area, and what is not answered does not count.
TEST(Texture, ATexelIsTheMeanOverItsArea) {
  Mesh mesh;
  add_uv_quad(mesh, {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, {{0, 0}, {0.25f, 1}});
  add_uv_quad(mesh, {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, {{0.25f, 0}, {0.75f, 1}});
  const CornerNormals normals(mesh, NormalSource::facet);
  const Ask by_side = [](std::span<const Receiver> receivers, const QueryOutputs& outputs, std::uint64_t) {
    for (std::size_t i = 0; i < receivers.size(); ++i)
      outputs.occlusion[i] = receivers[i].normal.y > 0.5f ? 1.0f : 0.5f;
  };
  const TextureBake baked = bake_texels(normals, scene::bounds_of(mesh), {.width = 2, .height = 1}, by_side);
  EXPECT_NEAR(baked.maps[0].occlusion[0], 0.75f, 1e-6);
  EXPECT_NEAR(baked.maps[0].occlusion[1], 0.5f, 1e-6);
  EXPECT_EQ(baked.maps[0].coverage, (std::vector<std::uint8_t>{255, 128}));
  const Ask one_side = [](std::span<const Receiver> receivers, const QueryOutputs& outputs, std::uint64_t) {
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      outputs.occlusion[i] = receivers[i].normal.y > 0.5f ? 0.25f : std::numeric_limits<float>::quiet_NaN();
    }
  };
  const TextureBake partly = bake_texels(normals, scene::bounds_of(mesh), {.width = 2, .height = 1}, one_side);
  EXPECT_EQ(partly.maps[0].occlusion[0], 0.25f);
  EXPECT_TRUE(std::isnan(partly.maps[0].occlusion[1]));
  EXPECT_EQ(partly.report.empty_texel_count, 1u);
}

// Smooth over its facets: no facet of a sphere hides anything from another, and rays from below are none.
TEST(Texture, ASmoothSphereHasNoTerminator) {
  Mesh mesh;
  add_uv_sphere(mesh, 1, 12, 6);
  const TextureBake baked = bake_map(mesh, {.width = 64, .height = 64}, 64, NormalSource::smooth);
  for (const float value : baked.maps[0].occlusion) EXPECT_EQ(value, 0);
}

TEST(Texture, ThicknessLooksInwards) {
  Mesh mesh;
  add_uv_sphere(mesh, 1, 12, 6);
  const TextureOptions options{.width = 32, .height = 32, .inwards = true};
  const TextureBake baked = bake_map(mesh, options, 64);
  for (const float value : baked.maps[0].occlusion) EXPECT_EQ(value, 1);
}

TEST(Texture, UdimTilesAreBakedEach) {
  Mesh mesh;
  add_uv_quad(mesh, {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, {{0.25f, 0.25f}, {0.75f, 0.75f}});
  add_uv_quad(mesh, {{5, 0, 0}, {5, 0, 1}, {6, 0, 1}, {6, 0, 0}}, {{1, -1}, {2, 0}});
  const TextureBake baked = bake_map(mesh, {.width = 16, .height = 16, .udim = true}, 64);
  ASSERT_EQ(baked.maps.size(), 2u);
  EXPECT_EQ(baked.maps[0].udim, 1001);
  EXPECT_EQ(baked.maps[1].udim, 1012);
  EXPECT_EQ(baked.report.covered_texel_count, 64u + 256u);
  EXPECT_EQ(baked.report.texel_count, 512u);
  for (const TextureMap& map : baked.maps) {
    for (const float value : map.occlusion) EXPECT_EQ(value, 0);
  }
}

TEST(Texture, UdimTilesThatNothingReachesAreNone) {
  Mesh mesh{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}, {{0, 1, 2}}};
  mesh.uvs = {{0.5f, -0.5f}, {0.5f, 0.4f}, {1.4f, -0.5f}};
  mesh.uv_corners = {{0, 1, 2}};
  std::vector<int> udims;
  const TextureBake baked = bake_map(mesh, {.width = 16, .height = 16, .udim = true}, 64);
  for (const TextureMap& map : baked.maps) udims.push_back(map.udim);
  EXPECT_EQ(udims, (std::vector<int>{1001, 1011, 1012})) << "the fourth is in the box around the triangle alone";
}

// An open floor: straight up, in its own space whichever way the chart lies.
TEST(Texture, BentNormalsOfAnOpenFloorPointUp) {
  for (const UvBox& box : {UvBox{{0, 0}, {1, 1}}, UvBox{{1, 0}, {0, 1}}}) {
    Mesh mesh;
    add_uv_quad(mesh, {{0, 0, 1}, {1, 0, 1}, {1, 0, 0}, {0, 0, 0}}, box);
    for (const BentNormals kind : {BentNormals::object, BentNormals::tangent}) {
      const TextureMap map = bake_map(mesh, {.width = 8, .height = 8, .bent_normals = kind}).maps[0];
      const glm::vec3 up = kind == BentNormals::object ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1);
      for (const glm::vec3& normal : map.bent_normals) EXPECT_GT(glm::dot(normal, up), 0.99f);
    }
  }
}

// At the foot of a wall light comes from before it.
TEST(Texture, BentNormalsLeanAwayFromAWall) {
  const Mesh mesh = floor_and_wall();
  const auto at_foot = [](const Mesh& of_mesh, BentNormals kind, const glm::ivec2& texel) {
    const TextureMap map =
        bake_map(of_mesh, {.width = 16, .height = 16, .bent_normals = kind}, 256, NormalSource::facet, 1e5f).maps[0];
    return map.bent_normals[map.texel(texel.x, texel.y)];
  };
  const glm::vec3 object = at_foot(mesh, BentNormals::object, {3, 0});
  EXPECT_GT(object.z, 0.2f);
  EXPECT_NEAR(object.x, 0, 0.1f);
  // The wall is at the upper edge of the map, where v upwards leads.
  const glm::vec3 tangent = at_foot(mesh, BentNormals::tangent, {3, 0});
  EXPECT_NEAR(tangent.y, -object.z, 0.05f);
  EXPECT_NEAR(tangent.z, object.y, 0.05f);
  Mesh mirrored = mesh;
  for (glm::vec2& uv : mirrored.uvs) uv.y = 1 - uv.y;
  const glm::vec3 other = at_foot(mirrored, BentNormals::tangent, {3, 15});
  EXPECT_NEAR(other.y, object.z, 0.1f);
  EXPECT_NEAR(other.z, object.y, 0.1f);
}

}  // namespace
}  // namespace lkao::bake
