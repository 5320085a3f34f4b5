#include "scene/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "scene/builtin.h"
#include "scene/shapes.h"

namespace lkao::scene::camera_test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

const Receiver& receiver_of(const ReceiverImage& image, int column, int row) {
  const auto pixel = static_cast<std::size_t>(row * image.width + column);
  EXPECT_TRUE(image.sees(pixel)) << "pixel " << column << ", " << row;
  return image.receivers[pixel];
}

TEST(Camera, FaultsAreNamed) {
  const auto fault = [](const Camera& camera) -> std::string {
    try {
      validate(camera);
      return "";
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  };
  const Camera good{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 60};
  EXPECT_EQ(fault(good), "");
  EXPECT_NE(fault({{1, 2, 3}, {1, 2, 3}, {0, 1, 0}, 60}).find("same point (1, 2, 3)"), std::string::npos);
  EXPECT_NE(fault({{0, 0, 5}, {0, 0, 0}, {0, 0, 0}, 60}).find("up is zero"), std::string::npos);
  EXPECT_NE(fault({{0, 5, 0}, {0, 0, 0}, {0, 1, 0}, 60}).find("along the view"), std::string::npos);
  EXPECT_NE(fault({{0, 0, kNaN}, {0, 0, 0}, {0, 1, 0}, 60}).find("eye is not finite"), std::string::npos);
  EXPECT_NE(fault({{0, 0, 5}, {0, kInfinity, 0}, {0, 1, 0}, 60}).find("target is not finite"), std::string::npos);
  for (float fov : {0.0f, -1.0f, 180.0f, kNaN}) {
    EXPECT_NE(fault({{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, fov}).find("fov"), std::string::npos) << fov;
  }
}

TEST(Camera, SizesAreChecked) {
  const Camera camera{{0, 3, 5}, {0, 0, 0}, {0, 1, 0}, 60};
  EXPECT_THROW(find_receivers(make_plane(), camera, 0, 10), std::invalid_argument);
  EXPECT_THROW(find_receivers(make_plane(), camera, 10, -1), std::invalid_argument);
  EXPECT_THROW(frame(bounds_of(Mesh{}), 1), std::invalid_argument);
}

// Looks straight down on the plane y = 0 from height 4; +x is right, -z is up in the image.
const Camera kDown{{1, 4, 2}, {1, 0, 2}, {0, 0, -1}, 90};

TEST(Receivers, TheCentreLooksAtTheTarget) {
  const ReceiverImage image = find_receivers(make_plane(), kDown, 101, 51);
  ASSERT_EQ(image.receivers.size(), 101u * 51u);
  ASSERT_EQ(image.receiver_count, 101u * 51u);
  const Receiver& receiver = receiver_of(image, 50, 25);
  EXPECT_LT(glm::distance(receiver.position, kDown.target), 1e-4f);
  EXPECT_EQ(receiver.normal, glm::vec3(0, 1, 0));
  EXPECT_EQ(receiver.excluded_primitive, kNoPrimitive);
}

TEST(Receivers, CornersSpanTheHorizontalFieldOfView) {
  // At 90 degrees and height 4, the image is 8 wide, a pixel 0.08, and 8 / 2 high.
  const ReceiverImage image = find_receivers(make_plane(), kDown, 100, 50);
  const glm::vec3 top_left = receiver_of(image, 0, 0).position;
  const glm::vec3 bottom_right = receiver_of(image, 99, 49).position;
  EXPECT_LT(glm::distance(top_left, glm::vec3(1 - 3.96, 0, 2 - 1.96)), 1e-4f);
  EXPECT_LT(glm::distance(bottom_right, glm::vec3(1 + 3.96, 0, 2 + 1.96)), 1e-4f);
}

TEST(Receivers, DepthIsAlongTheViewAxis) {
  const ReceiverImage image = find_receivers(make_plane(), kDown, 64, 48);
  for (float depth : image.depth) EXPECT_FLOAT_EQ(depth, 4);
}

// Interpolated, so that neighbours on a sphere of facets differ by little, and never below the facet's own horizon.
TEST(Receivers, ShadeSmoothlyAboveTheirFacets) {
  const glm::vec3 center(1, 2, 3);
  Mesh mesh;
  add_sphere(mesh, glm::dvec3(center), 2, 96, 48);
  const Camera camera = frame(bounds_of(mesh), 1);
  const ReceiverImage image = find_receivers(mesh, camera, 64, 64, NormalSource::smooth);
  const ReceiverImage facets = find_receivers(mesh, camera, 64, 64);
  ASSERT_GT(image.receiver_count, 500u);
  for (std::size_t pixel = 0; pixel < image.receivers.size(); ++pixel) {
    if (!image.sees(pixel)) continue;
    const Receiver& receiver = image.receivers[pixel];
    EXPECT_EQ(receiver.position, facets.receivers[pixel].position);
    EXPECT_EQ(receiver.geometric_normal, facets.receivers[pixel].normal);
    EXPECT_EQ(facets.receivers[pixel].geometric_normal, glm::vec3(0));
    EXPECT_NEAR(glm::length(receiver.normal), 1, 1e-6);
    EXPECT_GT(glm::dot(receiver.normal, glm::normalize(receiver.position - center)), 0.9999f);
  }
}

// Seen from behind, both normals turn round.
TEST(Receivers, ShadingNormalsTurnWithTheFacet) {
  Mesh mesh;
  mesh.positions = {{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}};
  mesh.triangles = {{0, 1, 2}};
  const glm::vec3 slanted = glm::normalize(glm::vec3(0.5f, 0, 1));
  mesh.normals = {slanted};
  mesh.normal_corners = {{0, 0, 0}};
  for (const float side : {1.0f, -1.0f}) {
    const ReceiverImage image =
        find_receivers(mesh, {{0, 0, 5 * side}, {0, 0, 0}, {0, 1, 0}, 40}, 9, 9, NormalSource::file);
    EXPECT_LT(glm::distance(receiver_of(image, 4, 4).normal, side * slanted), 1e-6f);
    EXPECT_EQ(receiver_of(image, 4, 4).geometric_normal, glm::vec3(0, 0, side));
  }
}

TEST(Receivers, LieOnTheirTriangleAndFaceTheEye) {
  // One large slanted triangle far from the origin, seen from its back.
  const glm::dvec3 offset(1000, -2000, 500);
  Mesh mesh;
  for (const glm::dvec3& p : {glm::dvec3(-9, -7, 0), glm::dvec3(8, -6, 2), glm::dvec3(0, 9, 4)}) {
    mesh.positions.emplace_back(p + offset);
  }
  mesh.triangles = {{0, 2, 1}};
  const Camera camera{glm::vec3(offset + glm::dvec3(0, 0, 20)), glm::vec3(offset), {0, 1, 0}, 40};
  const ReceiverImage image = find_receivers(mesh, camera, 80, 60);
  ASSERT_GT(image.receiver_count, 500u);
  const std::vector<Receiver> receivers = seen_receivers(image);
  ASSERT_EQ(receivers.size(), image.receiver_count);
  const glm::dvec3 a(mesh.positions[0]);
  const glm::dvec3 normal =
      glm::normalize(glm::cross(glm::dvec3(mesh.positions[1]) - a, glm::dvec3(mesh.positions[2]) - a));
  for (const Receiver& receiver : receivers) {
    const double distance = glm::dot(glm::dvec3(receiver.position) - a, normal);
    ASSERT_LT(std::abs(distance), 1e-6 * glm::length(offset));
    ASSERT_GT(glm::dot(receiver.normal, camera.eye - receiver.position), 0);
    ASSERT_NEAR(std::abs(glm::dot(glm::dvec3(receiver.normal), normal)), 1, 1e-6);
  }
}

TEST(Receivers, PixelsThatSeeNothingHaveInfiniteDepthAndNoNormal) {
  const Camera camera{{0, 1, 6}, {0, 1, 0}, {0, 1, 0}, 60};
  const Mesh mesh = {{{-1, 0, 0}, {1, 0, 0}, {0, 2, 0}}, {{0, 1, 2}}};
  const ReceiverImage image = find_receivers(mesh, camera, 60, 40);
  ASSERT_EQ(image.depth.size(), 2400u);
  ASSERT_EQ(image.receivers.size(), 2400u);
  const std::vector<Receiver> receivers = seen_receivers(image);
  ASSERT_EQ(receivers.size(), image.receiver_count);
  std::size_t seen = 0;
  for (std::size_t pixel = 0; pixel < 2400; ++pixel) {
    const Receiver& receiver = image.receivers[pixel];
    if (image.depth[pixel] == kInfinity) {
      ASSERT_FALSE(image.sees(pixel));
      ASSERT_EQ(receiver.normal, glm::vec3(0));
      ASSERT_TRUE(std::isnan(receiver.position.x) && std::isnan(receiver.position.y) &&
                  std::isnan(receiver.position.z));
      continue;
    }
    ASSERT_TRUE(image.sees(pixel));
    ASSERT_EQ(receivers.at(seen).position, receiver.position);  // in pixel order
    ++seen;
  }
  EXPECT_EQ(seen, image.receiver_count);
  EXPECT_GT(seen, 20u);
  EXPECT_LT(seen, 1000u);
}

TEST(Receivers, BadTrianglesAreNotSeen) {
  Mesh mesh = make_plane();
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {{kNaN, 1, 0}, {-9, 1, -9}, {9, 1, -9}, {0, 1, kInfinity}, {9, 1, 9}});
  mesh.triangles.insert(
      mesh.triangles.begin(),
      {{first, first + 1, first + 2}, {first + 1, first + 2, first + 3}, {first + 1, first + 1, first + 4}});
  const ReceiverImage image = find_receivers(mesh, kDown, 40, 30);
  ASSERT_EQ(image.receiver_count, 1200u);
  for (const Receiver& receiver : image.receivers) ASSERT_EQ(receiver.position.y, 0);
}

TEST(Receivers, AnEmptyMeshIsNotSeen) { EXPECT_EQ(find_receivers(Mesh{}, kDown, 8, 8).receiver_count, 0u); }

TEST(Receivers, BehindAreTheNextOnesOnTheRay) {
  // Three squares above each other, the lowest twice; all under the left half, the top one alone under the right.
  Mesh mesh;
  const auto add_square = [&](double x, double y, double size) {
    add_quad(mesh, {x, y, size}, {x + size, y, size}, {x + size, y, -size}, {x, y, -size});
  };
  add_square(-4, 1, 8);
  add_square(-4, 0, 4);
  add_square(-4, -1, 4);
  add_square(-4, -1.00001, 4);
  const Camera camera{{0, 5, 0}, {0, 0, 0}, {0, 0, -1}, 60};
  const ReceiverImage first = find_receivers(mesh, camera, 8, 6), second = find_behind(mesh, camera, first);
  const ReceiverImage third = find_behind(mesh, camera, second), fourth = find_behind(mesh, camera, third);
  EXPECT_EQ(first.receiver_count, 48u);
  EXPECT_EQ(second.receiver_count, 24u);
  EXPECT_EQ(third.receiver_count, 24u);
  EXPECT_EQ(fourth.receiver_count, 0u) << "the same surface once more";
  EXPECT_NEAR(receiver_of(second, 1, 2).position.y, 0, 1e-6);
  EXPECT_NEAR(receiver_of(third, 1, 2).position.y, -1, 1e-5);
  EXPECT_NEAR(second.depth[2 * 8 + 1], 5, 1e-5);
  EXPECT_FALSE(second.sees(2 * 8 + 6));
  EXPECT_EQ(receiver_of(second, 1, 2).normal, glm::vec3(0, 1, 0));
}

TEST(Frame, AllCornersOfTheBoxAreInside) {
  const Mesh box = [] {
    // Eight small triangles at the corners of a box.
    Mesh mesh;
    for (int i = 0; i < 8; ++i) {
      const glm::vec3 p((i & 1) != 0 ? 7.0f : 2.0f, (i & 2) != 0 ? 5.0f : -5.0f, (i & 4) != 0 ? 31.0f : 30.0f);
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      mesh.positions.insert(mesh.positions.end(), {p, p, p});
      mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    return mesh;
  }();
  for (const glm::vec3& up : {glm::vec3(0, 1, 0), glm::vec3(0, 0, 1), glm::vec3(1, 2, -1)}) {
    for (float aspect : {0.5f, 1.0f, 2.0f}) {
      const Camera camera = frame(bounds_of(box), aspect, up, 50);
      validate(camera);
      const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
      const glm::vec3 right = glm::normalize(glm::cross(forward, up));
      const float tan_x = std::tan(0.5f * 50 * 3.14159265f / 180);
      float widest = 0;
      for (const glm::vec3& p : box.positions) {
        const glm::vec3 d = p - camera.eye;
        const float depth = glm::dot(d, forward);
        ASSERT_GT(depth, 0);
        const float x = std::abs(glm::dot(d, right)) / depth / tan_x;
        const float y = std::abs(glm::dot(d, glm::cross(right, forward))) / depth / tan_x * aspect;
        widest = std::max({widest, x, y});
      }
      EXPECT_LE(widest, 1);
      EXPECT_GT(widest, 0.9f);  // and the box fills the image
      EXPECT_GT(glm::dot(camera.eye - camera.target, up), 0);
    }
  }
}

}  // namespace
}  // namespace lkao::scene::camera_test
