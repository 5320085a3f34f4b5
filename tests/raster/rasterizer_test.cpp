// What is drawn of a camera's receivers is what the query says of them, pixel by pixel.
#include "raster/rasterizer.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include <glm/geometric.hpp>

#include "gpu/on_software.h"
#include "lkao/ambient_occlusion.h"
#include "raster/small_scene.h"

namespace lkao::raster::tests {
namespace {

// A frame, by either side.
struct Frame {
  std::vector<float> occlusion;
  std::vector<glm::vec3> bent_normals;
  std::vector<std::uint64_t> masks;
};

class RasterizerTest : public gl::tests::OnSoftware {
 protected:
  void SetUp() override {
    OnSoftware::SetUp();
    if (!IsSkipped()) rasterizer_.emplace(gl::Device::software);
  }

  void look(int width, int height) {
    image_ = scene::find_receivers(mesh_, small_camera(), width, height);
    rasterizer_->set_view(small_camera(), image_);
  }

  Frame draw(const RayOptions& options) {
    EXPECT_GT(rasterizer_->draw(options, {}, true), 0);
    return {rasterizer_->read_occlusion(), rasterizer_->read_bent_normals(), rasterizer_->pass().read_masks()};
  }

  Frame ask(const SamplePattern& pattern, const RayOptions& options) const {
    const AmbientOcclusion ao(OccluderBvh(mesh_.view()), pattern, options);
    const std::size_t count = image_.receivers.size();
    Frame frame;
    frame.occlusion.resize(count);
    frame.bent_normals.resize(count);
    frame.masks.resize(count * static_cast<std::size_t>(pattern.word_count()));
    ao.query(image_.receivers, {frame.occlusion, frame.bent_normals, frame.masks});
    return frame;
  }

  static std::uint64_t count_differing_rays(const Frame& a, const Frame& b) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < a.masks.size(); ++i)
      count += static_cast<unsigned>(std::popcount(a.masks[i] ^ b.masks[i]));
    return count;
  }

  // Rays differ by rounding only, and each pixel's values are those of its mask.
  void expect_same(const Frame& drawn, const Frame& asked) const {
    ASSERT_EQ(drawn.masks.size(), asked.masks.size());
    ASSERT_EQ(drawn.occlusion.size(), image_.receivers.size());
    EXPECT_LE(static_cast<double>(count_differing_rays(drawn, asked)),
              1e-4 * 64 * static_cast<double>(drawn.masks.size()));
    const std::size_t words = drawn.masks.size() / image_.receivers.size();
    for (std::size_t pixel = 0; pixel < image_.receivers.size(); ++pixel) {
      ASSERT_EQ(std::isnan(drawn.occlusion[pixel]), !image_.sees(pixel)) << pixel;
      ASSERT_EQ(std::isnan(drawn.bent_normals[pixel].x), !image_.sees(pixel)) << pixel;
      const auto first = static_cast<std::ptrdiff_t>(pixel * words);
      const auto mask = drawn.masks.begin() + first;
      const bool is_same = std::equal(mask, mask + static_cast<std::ptrdiff_t>(words), asked.masks.begin() + first);
      if (!image_.sees(pixel) || !is_same) continue;
      ASSERT_NEAR(drawn.occlusion[pixel], asked.occlusion[pixel], 1e-6) << pixel;
      ASSERT_LT(glm::distance(drawn.bent_normals[pixel], asked.bent_normals[pixel]), 1e-4f) << pixel;
    }
  }

  scene::Mesh mesh_ = small_scene();
  scene::ReceiverImage image_;
  std::optional<Rasterizer> rasterizer_;
};

PlaneMaskTable make_table(const SamplePattern& pattern, PlaneMasks masks = PlaneMasks::must_may) {
  return PlaneMaskTable(pattern, {.resolution = 48, .masks = masks});
}

TEST_F(RasterizerTest, ExactMasksAreTheQuerysAtAnySize) {
  const SamplePattern& pattern = SamplePattern::standard(128);
  rasterizer_->start_pass({}, mesh_, make_table(pattern));
  for (const auto& [width, height] : {std::pair{1, 1}, {33, 17}, {17, 33}, {90, 61}}) {
    SCOPED_TRACE(testing::Message() << width << "x" << height);
    look(width, height);
    ASSERT_TRUE(width == 1 || image_.receiver_count < image_.receivers.size()) << "no background";
    ASSERT_GT(image_.receiver_count, image_.receivers.size() / 8);
    const RayOptions options{.radius = 0.5f, .seed = 5};
    const Frame asked = ask(pattern, options);
    std::uint64_t blocked_count = 0;
    for (const std::uint64_t word : asked.masks) blocked_count += static_cast<unsigned>(std::popcount(word));
    EXPECT_GT(blocked_count, (width == 1 ? 4 : 16) * image_.receiver_count) << "too little occlusion to tell anything";
    expect_same(draw(options), asked);
  }
}

TEST_F(RasterizerTest, FollowsSidednessFalloffSamplesAndTilt) {
  look(45, 32);
  const RayOptions options{.radius = 0.6f, .sidedness = Sidedness::one_sided, .jitter = {0.5f, 0.1f}, .seed = 7};
  for (const int ray_count : {64, 192}) {
    const SamplePattern pattern = SamplePattern::standard(ray_count).with_falloff(Falloff::linear());
    rasterizer_->start_pass({.geometry = gl::GeometryBackEnd::geometry_shader}, mesh_, make_table(pattern));
    expect_same(draw(options), ask(pattern, options));
  }
}

TEST_F(RasterizerTest, FollowsGeometricNormals) {
  image_ = scene::find_receivers(mesh_, small_camera(), 40, 30);
  for (std::size_t pixel = 0; pixel < image_.receivers.size(); ++pixel) {
    Receiver& receiver = image_.receivers[pixel];
    if (!image_.sees(pixel) || pixel % 3 == 0) continue;  // zero: the same as the normal
    receiver.geometric_normal = receiver.normal;
    receiver.normal = glm::normalize(receiver.normal + glm::vec3(0.3f, 0.5f, -0.2f));
  }
  rasterizer_->set_view(small_camera(), image_);
  const SamplePattern& pattern = SamplePattern::standard(64);
  rasterizer_->start_pass({}, mesh_, make_table(pattern));
  const RayOptions options{.radius = 0.5f};
  expect_same(draw(options), ask(pattern, options));
}

TEST_F(RasterizerTest, OnePassDrawsBothKindsOfMasksAndCounts) {
  look(60, 45);
  const SamplePattern& pattern = SamplePattern::standard(128);
  const RayOptions options{.radius = 0.5f};
  rasterizer_->start_pass({.count_fragments = true}, mesh_, make_table(pattern));
  const Frame exact = draw(options), again = draw(options);
  EXPECT_EQ(exact.masks, again.masks);
  const gl::FragmentCounts counts = rasterizer_->pass().read_fragment_counts();
  EXPECT_GT(counts.masks, image_.receiver_count / 2);

  rasterizer_->pass().set_table(make_table(pattern, PlaneMasks::nearest));
  const Frame nearest = draw(options);
  const std::uint64_t difference_count = count_differing_rays(exact, nearest);
  EXPECT_GT(difference_count, 0u);
  EXPECT_LT(static_cast<double>(difference_count), 0.02 * 128 * static_cast<double>(image_.receiver_count));
  EXPECT_EQ(rasterizer_->pass().read_fragment_counts().masks, counts.masks);
}

TEST_F(RasterizerTest, NamesTheStepThatIsMissing) {
  const auto expect = [](const std::string& named, const std::function<void()>& mistake) {
    try {
      mistake();
      ADD_FAILURE() << "no exception about " << named;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(named), std::string::npos) << error.what();
    }
  };
  expect("start_pass()", [&] { rasterizer_->draw({.radius = 1.0f}); });
  rasterizer_->start_pass({}, mesh_, make_table(SamplePattern::standard(64)));
  expect("set_view()", [&] { rasterizer_->draw({.radius = 1.0f}); });
  look(4, 3);
  expect("draw()", [&] { rasterizer_->read_occlusion(); });
  rasterizer_->draw({.radius = 1.0f});
  EXPECT_EQ(rasterizer_->read_occlusion().size(), 12u);
  expect("bent normals", [&] { rasterizer_->read_bent_normals(); });
  look(5, 3);
  expect("draw()", [&] { rasterizer_->read_occlusion(); });
  expect("1048576x1", [&] { rasterizer_->require_size(1 << 20, 1); });
}

}  // namespace
}  // namespace lkao::raster::tests
