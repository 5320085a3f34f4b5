#include "lut/mesh_views.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "lkao/index_view.h"
#include "lkao/position_view.h"

namespace lkao {
namespace {

struct Vertex {
  float u, v;
  float position[3];
  std::uint8_t colour[4];
};

const Vertex kVertices[] = {{7, 7, {0, 1, 2}, {9}}, {7, 7, {3, 4, 5}, {9}}, {7, 7, {6, 7, 8}, {9}}};

void expect_points(const PositionView& view) {
  ASSERT_EQ(view.size(), 3u);
  EXPECT_EQ(view[0], glm::vec3(0, 1, 2));
  EXPECT_EQ(view[1], glm::vec3(3, 4, 5));
  EXPECT_EQ(view[2], glm::vec3(6, 7, 8));
}

TEST(PositionView, ComesFromAnyContainerOfVectors) {
  const std::vector<glm::vec3> vector = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  const std::array<glm::vec3, 3> array = {{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}};
  glm::vec3 c_array[] = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  expect_points(vector);
  expect_points(array);
  expect_points(c_array);
  expect_points(std::span(c_array));
  EXPECT_EQ(PositionView().size(), 0u);
}

TEST(PositionView, SeesPackedPaddedAndInterleavedPoints) {
  const float packed[] = {0, 1, 2, 3, 4, 5, 6, 7, 8};
  const float padded[] = {0, 1, 2, 99, 3, 4, 5, 99, 6, 7, 8, 99};
  expect_points({packed, 3});
  expect_points({padded, 3, 4 * sizeof(float)});
  expect_points({kVertices[0].position, 3, sizeof(Vertex)});
}

// Copies of the values, each `stride` bytes after the one before, the first at an odd address.
std::vector<std::byte> scattered(const void* values, std::size_t size, std::size_t count, std::size_t stride) {
  std::vector<std::byte> bytes(1 + stride * (count - 1) + size);
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(&bytes[1 + i * stride], static_cast<const std::byte*>(values) + i * size, size);
  }
  return bytes;
}

TEST(PositionView, NeedsNoAlignment) {
  const float packed[] = {0, 1, 2, 3, 4, 5, 6, 7, 8};
  const std::vector<std::byte> bytes = scattered(packed, 12, 3, 13);
  expect_points({reinterpret_cast<const float*>(&bytes[1]), 3, 13});
}

TEST(PositionView, SeesDoublesLessAnOrigin) {
  struct {
    double x, y, z;
    int colour;
  } const vertices[] = {{5e6, 1 + 4e5, 2, 9}, {5e6 + 3, 4 + 4e5, 5, 9}, {5e6 + 6, 7 + 4e5, 8, 9}};
  const glm::dvec3 origin(5e6, 4e5, 0);
  expect_points({&vertices[0].x, 3, origin, sizeof(vertices[0])});
  const std::vector<glm::dvec3> vector = {{5e6, 1 + 4e5, 2}, {5e6 + 3, 4 + 4e5, 5}, {5e6 + 6, 7 + 4e5, 8}};
  const PositionView view(vector, origin);
  expect_points(view);
  EXPECT_EQ(view.origin(), origin);
  EXPECT_EQ(view.exact(1), vector[1]);
  EXPECT_FALSE(view.is_packed());
}

glm::dvec3 origin_of(const std::vector<glm::dvec3>& positions) { return choose_origin({positions, glm::dvec3(0)}); }

TEST(ChooseOrigin, IsZeroUnlessTheBoxIsFar) {
  EXPECT_EQ(origin_of({}), glm::dvec3(0));
  EXPECT_EQ(origin_of({{-1, 0, 5}, {1, 2, 9}}), glm::dvec3(0));
  EXPECT_EQ(origin_of({{1e9, 1e9, 1e9}}), glm::dvec3(0)) << "a box without extent";
  EXPECT_EQ(origin_of({{std::numeric_limits<double>::quiet_NaN(), 0, 0}, {1e30, 0, 0}}), glm::dvec3(0));
}

TEST(ChooseOrigin, IsRoundAndNear) {
  EXPECT_EQ(origin_of({{448262.3, 5413678.1, 112.4}, {448262.8, 5413678.6, 112.7}, {1e30, 0, 0}}),
            glm::dvec3(448263, 5413678, 113));
  EXPECT_EQ(choose_origin(std::vector<glm::vec3>{{1000, 0, 0}, {1001, 4, 3}}), glm::dvec3(1000, 0, 0));
}

void expect_triangles(const IndexView& view) {
  ASSERT_EQ(view.size(), 2u);
  EXPECT_EQ(view[0], glm::uvec3(0, 2, 1));
  EXPECT_EQ(view[1], glm::uvec3(3, 40000, 5));
  EXPECT_EQ(view.index(1, 1), 40000);
}

TEST(IndexView, ComesFromAnyContainerOfTriangles) {
  const std::vector<glm::uvec3> vector = {{0, 2, 1}, {3, 40000, 5}};
  const glm::uvec3 c_array[] = {{0, 2, 1}, {3, 40000, 5}};
  expect_triangles(vector);
  expect_triangles(c_array);
  EXPECT_EQ(IndexView().size(), 0u);
}

template <typename Index>
class IndexViewOf : public testing::Test {};
using IndexTypes = testing::Types<std::uint16_t, std::uint32_t, std::int32_t>;
TYPED_TEST_SUITE(IndexViewOf, IndexTypes);

TYPED_TEST(IndexViewOf, SeesPackedPaddedAndUnalignedTriangles) {
  const TypeParam packed[] = {0, 2, 1, 3, 40000, 5}, padded[] = {0, 2, 1, 99, 3, 40000, 5, 99};
  expect_triangles({packed, 2});
  expect_triangles({padded, 2, 4 * sizeof(TypeParam)});
  constexpr std::size_t kSize = 3 * sizeof(TypeParam);
  const std::vector<std::byte> bytes = scattered(packed, kSize, 2, kSize + 5);
  expect_triangles({reinterpret_cast<const TypeParam*>(&bytes[1]), 2, kSize + 5});
}

template <typename Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(MeshViews, RefuseStridesThatOverlap) {
  const float positions[12] = {};
  const double doubles[6] = {};
  const std::uint16_t indices[12] = {};
  const std::int32_t wide_indices[12] = {};
  EXPECT_EQ(error_of([&] { PositionView(positions, 2, 8); }),
            "stride of positions must be 0 or at least 12 bytes, not 8");
  EXPECT_EQ(error_of([&] { PositionView(doubles, 2, glm::dvec3(0), 23); }),
            "stride of positions must be 0 or at least 24 bytes, not 23");
  EXPECT_EQ(error_of([&] { PositionView(doubles, 2, glm::dvec3(0, 1.0 / 0.0, 0)); }),
            "origin of positions must be finite, not inf");
  EXPECT_EQ(error_of([&] { IndexView(indices, 2, 4); }), "stride of triangles must be 0 or at least 6 bytes, not 4");
  EXPECT_EQ(error_of([&] { IndexView(wide_indices, 2, 11); }),
            "stride of triangles must be 0 or at least 12 bytes, not 11");
}

TEST(MeshViews, NameAnIndexThatNoPositionHas) {
  const std::int32_t negative[] = {0, 1, 2, 2, -1, 0};
  const std::uint16_t large[] = {0, 1, 65535};
  const auto check = [](const IndexView& view) { return error_of([&] { lut::check_indices(view, 3); }); };
  EXPECT_EQ(check({negative, 1}), "");
  EXPECT_EQ(check({negative, 2}), "triangle 1 has index -1, but there are 3 positions");
  EXPECT_EQ(check({large, 1}), "triangle 0 has index 65535, but there are 3 positions");
  EXPECT_EQ(check(std::vector<glm::uvec3>{{0, 3, 1}}), "triangle 0 has index 3, but there are 3 positions");
}

}  // namespace
}  // namespace lkao
