// The share of the sky over the whole sphere.
#include "lkao/sky_visibility.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "support/meshes.h"

namespace lkao {
namespace {

// Where a leaf lies, with rounding: on the plane x + y + z = 1.
constexpr Receiver kLeaf{.position = {0.2f, 0.3f, 0.5f}, .normal = {1, 1, 1}};

tests::Mesh leaf_mesh() {
  tests::Mesh mesh;
  mesh.positions = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

SkyShares mean_of(const tests::Mesh& mesh, const Receiver& receiver) {
  const SkyVisibility sky(OccluderBvh(mesh.view()), 512);
  const std::vector<Receiver> receivers(100, receiver);
  std::vector<SkyShares> shares(receivers.size());
  EXPECT_EQ(sky.query(receivers, shares).ray_count, 512u * 100);
  SkyShares mean;
  for (const SkyShares& one : shares) {
    mean.visibility += one.visibility / 100;
    mean.above += one.above / 100;
    mean.below += one.below / 100;
  }
  return mean;
}

TEST(SkyVisibility, ALeafHidesNothingFromItself) {
  const SkyShares alone = mean_of(leaf_mesh(), kLeaf);
  EXPECT_NEAR(alone.above, 1, 1e-6);
  EXPECT_NEAR(alone.below, 1, 1e-6);
  EXPECT_NEAR(alone.visibility, 1, 1e-6);
}

// A ground below, of which the upper side sees nothing.
TEST(SkyVisibility, SidesAreToldApart) {
  tests::Mesh mesh;
  tests::add_quad(mesh, {-1e5f, 0, -1e5f}, {0, 0, 2e5f}, {2e5f, 0, 0});
  const SkyShares shares = mean_of(mesh, {.position = {0, 1, 0}, .normal = {0, 1, 0}});
  EXPECT_NEAR(shares.above, 1, 1e-5);
  EXPECT_NEAR(shares.below, 0, 1e-4);
  EXPECT_NEAR(shares.visibility, 0.5, 1e-4);
  const SkyShares turned = mean_of(mesh, {.position = {0, 1, 0}, .normal = {0, 1, 0}, .geometric_normal = {0, -2, 0}});
  EXPECT_NEAR(turned.above, 0, 1e-4);
}

// A quarter of a hemisphere's solid angle is hidden by what lies on one side of a wall of the same height as its
// distance: a wedge of atan 1 of pi.
TEST(SkyVisibility, AWallHidesAWedge) {
  tests::Mesh wall;
  tests::add_quad(wall, {1, 0, -1e4f}, {0, 1, 0}, {0, 0, 2e4f});
  const SkyShares shares = mean_of(wall, {.position = {0, 0, 0}, .normal = {0, 1, 0}});
  EXPECT_NEAR(shares.above, 0.75, 3e-3);
  EXPECT_NEAR(shares.below, 1, 1e-3);
}

TEST(SkyVisibility, ABatchIsItsReceivers) {
  const SkyVisibility sky(OccluderBvh(tests::random_soup(500, 0.3f, 221).view()), 64, {.radius = 2, .seed = 3});
  std::vector<Receiver> receivers(50, kLeaf);
  for (std::size_t k = 0; k < receivers.size(); ++k) receivers[k].position.x = 0.01f * static_cast<float>(k);
  receivers[7].normal = {};
  std::vector<SkyShares> shares(receivers.size());
  EXPECT_EQ(sky.query(receivers, shares, 5).invalid_receiver_count, 1u);
  EXPECT_TRUE(std::isnan(shares[7].visibility));
  for (std::size_t k = 8; k < receivers.size(); ++k) {
    const SkyShares single = sky.query(receivers[k], 5 + k);
    EXPECT_EQ(single.above, shares[k].above);
    EXPECT_EQ(single.below, shares[k].below);
    EXPECT_LT(single.visibility, 1);
  }
}

TEST(SkyVisibility, NamesBadArguments) {
  const OccluderBvh occluders(leaf_mesh().view());
  EXPECT_THROW(SkyVisibility(occluders, 1), std::invalid_argument);
  EXPECT_THROW(SkyVisibility(occluders, 2049), std::invalid_argument);
  EXPECT_THROW(SkyVisibility(occluders, 64, {.radius = 0}), std::invalid_argument);
  const std::vector<Receiver> receivers(3, kLeaf);
  std::vector<SkyShares> shares(2);
  EXPECT_THROW(SkyVisibility(occluders).query(receivers, shares), std::invalid_argument);
}

}  // namespace
}  // namespace lkao
