// The volume pass against its definition, whatever way it takes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "gpu/in_furnished_room.h"
#include "gpu/volumes_definition.h"
#include "support/sanitized.h"

namespace lkao::gl::tests::volumes_pass_test {
namespace {

constexpr int kWidth = lkao::tests::unless_sanitized(48, 40);
constexpr int kHeight = lkao::tests::unless_sanitized(36, 30);

class VolumesOnRoom : public InFurnishedRoom<kWidth, kHeight> {
 protected:
  // What a pass writes; the background is -1.
  static std::vector<float> draw(VolumePass& pass, const Occluders& occluders, const GBuffer& g_buffer,
                                 const Camera& camera, const RayOptions& options, const VolumeOptions& volumes = {}) {
    const Texture target = make_image(GL_R32F, g_buffer.width, g_buffer.height);
    pass.draw(occluders, g_buffer, camera, options, {target.name(), -1}, volumes);
    std::vector<float> occlusion;
    for (const glm::vec4& texel : read_image(target.name(), g_buffer.width, g_buffer.height)) {
      occlusion.push_back(texel.x);
    }
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    return occlusion;
  }

  Occluders occluders() const { return Occluders(mesh_.positions, mesh_.triangles); }

  // Of the same terms. On GPUs their order, and with it the rounding of floats, differs from frame to frame.
  void expect_equal_sums(const std::vector<float>& one, const std::vector<float>& other) const {
    const float tolerance = context_->is_software() ? 0 : 1e-6f;
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(one[i], other[i], tolerance);
  }
};

RayOptions options_of(float radius, bool is_two_sided) {
  return {.radius = radius, .sidedness = sidedness_of(is_two_sided), .surface_offset = kQuerySurfaceOffset};
}

struct Errors {
  double largest = 0;
  double mean = 0;
  std::size_t far_count = 0;  // off by more than 1e-4
  double mean_occlusion = 0;
};

Errors errors_of(const std::vector<float>& drawn, const Mesh& mesh, const std::vector<VolumeReceiver>& receivers,
                 const VolumeDefinition& definition) {
  Errors errors;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const double right =
        receivers[i].normal == glm::dvec3(0) ? -1 : std::min(definition.occlusion(mesh, receivers[i]), 1.0);
    const double error = std::fabs(static_cast<double>(drawn[i]) - right);
    errors.largest = std::fmax(errors.largest, error);
    errors.mean += error / static_cast<double>(receivers.size());
    errors.far_count += error > 1e-4;
    errors.mean_occlusion += right / static_cast<double>(receivers.size());
  }
  return errors;
}

TEST_F(VolumesOnRoom, AreWhatTheirDefinitionSays) {
  const Occluders occluders = this->occluders();
  VolumePass pass({.accessibility = Accessibility::bits32});
  // A wide camera, inside of many volumes; one far off; an orthographic and a mirrored one.
  Camera orthographic = camera_, mirrored = camera_;
  orthographic.projection = glm::ortho(-2.0f, 2.0f, -1.5f, 1.5f, 0.1f, 20.0f);
  mirrored.projection[1] *= -1;
  for (const Camera& camera : {camera_, orthographic, mirrored}) {
    const GBufferPass g_buffer(mesh_, camera, kWidth, kHeight);
    for (const bool is_two_sided : {true, false}) {
      for (const float radius : {0.3f, 2.0f}) {
        for (const bool clamps : {true, false}) {
          SCOPED_TRACE(testing::Message() << "two-sided " << is_two_sided << ", radius " << radius << ", clamps "
                                          << clamps << ", mirrored " << (camera.projection[1][1] < 0)
                                          << ", perspective " << (camera.projection[2][3] != 0));
          if (radius > 1 && clamps != is_two_sided) continue;  // for time
          const RayOptions options = options_of(radius, is_two_sided);
          const Errors errors =
              errors_of(draw(pass, occluders, g_buffer.by_positions(), camera, options, {.clamps_extensions = clamps}),
                        mesh_, volume_receivers(mesh_, g_buffer.receivers(), options), {radius, is_two_sided, clamps});
          // Rounding may put a receiver on the other side of a clamped volume's cut.
          EXPECT_LE(errors.far_count, clamps ? 8u : 0u);
          EXPECT_LE(errors.largest, clamps ? 0.02 : 1e-4);
          EXPECT_LT(errors.mean, 2e-5);
          EXPECT_GT(errors.mean_occlusion, 0.02);
        }
      }
    }
  }
}

TEST_F(VolumesOnRoom, TakeNormalsAndGeometricNormals) {
  lut::RandomStream random(6);
  std::vector<Receiver> receivers = g_buffer_->receivers();
  std::vector<glm::vec4> normals, ups;
  for (Receiver& receiver : receivers) {
    receiver.geometric_normal = receiver.normal;
    receiver.normal = glm::normalize(receiver.normal) + 0.7f * lkao::tests::random_direction(random);
    normals.emplace_back(receiver.normal, 0);
    ups.emplace_back(receiver.geometric_normal, 0);
  }
  const Texture shading = make_image(GL_RGBA32F, kWidth, kHeight, &normals[0].x);
  const Texture geometric = make_image(GL_RGBA32F, kWidth, kHeight, &ups[0].x);
  GBuffer textures = g_buffer_->by_positions();
  textures.normals = shading.name();
  textures.geometric_normals = geometric.name();
  VolumePass pass({.accessibility = Accessibility::bits32});
  const RayOptions options = options_of(0.8f, true);
  const Errors errors = errors_of(draw(pass, occluders(), textures, camera_, options, {.clamps_extensions = false}),
                                  mesh_, volume_receivers(mesh_, receivers, options), {0.8, true, false});
  EXPECT_LT(errors.largest, 1e-4);
  // And back to one horizon.
  const std::vector<float> one = draw(pass, occluders(), g_buffer_->by_positions(), camera_, options);
  VolumePass fresh({.accessibility = Accessibility::bits32});
  expect_equal_sums(one, draw(fresh, occluders(), g_buffer_->by_positions(), camera_, options));
}

TEST_F(VolumesOnRoom, AreTheSameByAllBackEndsKeptOrNot) {
  const Occluders occluders = this->occluders();
  std::vector<float> first[2][2];
  for (const GeometryBackEnd geometry : {GeometryBackEnd::vertex_pulling, GeometryBackEnd::geometry_shader}) {
    for (const bool keeps : {false, true}) {
      VolumePass pass({.geometry = geometry, .keeps_volumes = keeps, .count_fragments = true});
      EXPECT_EQ(pass.geometry(), geometry);
      for (const bool is_two_sided : {false, true}) {
        for (const bool clamps : {false, true}) {
          std::vector<float>& expected = first[is_two_sided][clamps];
          for (int frame = 0; frame < (keeps ? 2 : 1); ++frame) {
            const std::vector<float> drawn = draw(pass, occluders, g_buffer_->by_positions(), camera_,
                                                  options_of(0.8f, is_two_sided), {.clamps_extensions = clamps});
            if (expected.empty()) expected = drawn;
            EXPECT_EQ(drawn, expected) << "kept " << keeps << ", frame " << frame;
          }
          const VolumeFragments counts = pass.read_fragment_counts();
          EXPECT_GT(counts.drawn, counts.inside);
          EXPECT_GT(counts.inside, counts.blended);
          EXPECT_GT(counts.blended, std::uint64_t{kWidth} * kHeight);
        }
      }
    }
  }
  EXPECT_NE(first[0][0], first[1][0]) << "sides";
  EXPECT_NE(first[0][0], first[0][1]) << "clamp";
}

TEST_F(VolumesOnRoom, KeptOnesFollowTheMesh) {
  VolumePass keeping({.keeps_volumes = true}), finding;
  Occluders occluders = this->occluders();
  const RayOptions options = options_of(0.5f, true);
  const auto expect_same = [&](const RayOptions& rays, const VolumeOptions& volumes, const char* after) {
    EXPECT_EQ(draw(keeping, occluders, g_buffer_->by_positions(), camera_, rays, volumes),
              draw(finding, occluders, g_buffer_->by_positions(), camera_, rays, volumes))
        << after;
  };
  expect_same(options, {}, "the first frame");
  Mesh moved = mesh_;
  for (std::size_t i = 24; i < moved.positions.size(); ++i) moved.positions[i] += glm::vec3(0.2f, 0.1f, 0.3f);
  occluders.update_positions(moved.positions);
  expect_same(options, {}, "moving");
  expect_same(options_of(0.7f, false), {}, "another radius");
  expect_same(options_of(0.7f, false), {.clamps_extensions = false}, "another clamp");
  occluders.set_opacities(std::vector<float>(mesh_.triangles.size(), 0.5f));
  expect_same(options, {}, "opacities");
  occluders = Occluders(moved.positions, std::span(moved.triangles).first(100));
  expect_same(options, {}, "another mesh");
  // By the GPU: only who writes there knows.
  glNamedBufferSubData(occluders.positions_buffer(), 0,
                       static_cast<GLsizeiptr>(mesh_.positions.size() * sizeof(glm::vec3)), mesh_.positions.data());
  keeping.forget_volumes();
  expect_same(options, {}, "moving by the GPU");
}

TEST_F(VolumesOnRoom, TakeOpacities) {
  lut::RandomStream random(8);
  std::vector<float> opacities;
  for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) opacities.push_back(lkao::tests::uniform(random, 0, 1));
  Occluders occluders = this->occluders();
  VolumePass pass({.accessibility = Accessibility::bits32});
  const RayOptions options = options_of(0.8f, true);
  const auto drawn = [&] {
    return draw(pass, occluders, g_buffer_->by_positions(), camera_, options, {.clamps_extensions = false});
  };
  const std::vector<float> solid = drawn();
  occluders.set_opacities(opacities);
  const Errors errors = errors_of(drawn(), mesh_, volume_receivers(mesh_, g_buffer_->receivers(), options),
                                  {0.8, true, false, opacities});
  EXPECT_LT(errors.largest, 1e-4);
  std::fill(opacities.begin(), opacities.end(), 0.0f);
  occluders.set_opacities(opacities);
  for (const float value : drawn()) EXPECT_EQ(value, 0);
  occluders.set_opacities({});
  expect_equal_sums(drawn(), solid);
}

TEST_F(VolumesOnRoom, SaturateInEveryFormat) {
  // At a large radius, in a corner, the sum goes beyond 1.
  const Occluders occluders = this->occluders();
  const RayOptions options = options_of(6.0f, true);
  VolumePass floats({.accessibility = Accessibility::bits32});
  const std::vector<float> exact = draw(floats, occluders, g_buffer_->by_positions(), camera_, options);
  const auto full_count = std::count(exact.begin(), exact.end(), 1.0f);
  EXPECT_GT(full_count, 10);
  EXPECT_LT(full_count, static_cast<std::ptrdiff_t>(exact.size()));
  for (const auto& [format, step] :
       {std::pair{Accessibility::bits16, 1.0 / 65535}, {Accessibility::bits8, 1.0 / 255}}) {
    VolumePass pass({.accessibility = format, .count_fragments = true});
    const std::vector<float> drawn = draw(pass, occluders, g_buffer_->by_positions(), camera_, options);
    double mean = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      EXPECT_GE(drawn[i], 0);
      EXPECT_LE(drawn[i], 1);
      // Half a step for each of all triangles, at most.
      EXPECT_NEAR(drawn[i], exact[i], 420 * step);
      mean += std::fabs(static_cast<double>(drawn[i] - exact[i])) / static_cast<double>(exact.size());
    }
    // Blending rounds, or on GPUs cuts off: half a step each time.
    EXPECT_LT(mean, (context_->is_software() ? 25 : 100) * step);
  }
}

TEST_F(VolumesOnRoom, AreTheSameOnEveryKindOfGBuffer) {
  const Occluders occluders = this->occluders();
  VolumePass pass({.accessibility = Accessibility::bits32});
  RayOptions options = options_of(0.8f, true);
  options.surface_offset = kAutomaticSurfaceOffset;
  const std::vector<float> expected = draw(pass, occluders, g_buffer_->by_positions(), camera_, options);
  for (const GBuffer& textures :
       {g_buffer_->by_view_positions(), g_buffer_->by_linear_depth(), g_buffer_->by_depth()}) {
    const std::vector<float> drawn = draw(pass, occluders, textures, camera_, options);
    double mean = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      mean += std::fabs(static_cast<double>(drawn[i] - expected[i])) / static_cast<double>(drawn.size());
    }
    EXPECT_LT(mean, 2e-3);
  }
}

TEST_F(VolumesOnRoom, TakeEveryNthPixelAndPartsOfTextures) {
  const Occluders occluders = this->occluders();
  VolumePass pass({.accessibility = Accessibility::bits32});
  const RayOptions options = options_of(0.8f, true);
  const std::vector<float> whole = draw(pass, occluders, g_buffer_->by_positions(), camera_, options);
  for (const int step : {1, 2, 5}) {
    GBuffer textures = g_buffer_->by_positions();
    textures.step = step;
    const int width = textures.picture_width(), height = textures.picture_height();
    // Into the green of a part of a larger texture, as visibility.
    const Texture target = make_image(GL_RGBA16F, width + 5, height + 9);
    pass.draw(occluders, textures, camera_, options,
              {target.name(), -1, Quantity::visibility, Channel::green, Part{3, 7}});
    const std::vector<glm::vec4> texels = read_image(target.name(), width + 5, height + 9);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const glm::vec4& texel = texels[static_cast<std::size_t>((y + 7) * (width + 5) + x + 3)];
        const float expected = whole[static_cast<std::size_t>(step * y * kWidth + step * x)];
        // Rounding may put a receiver on the other side of a clamped volume's cut.
        EXPECT_NEAR(texel.y, expected < 0 ? -1 : 1 - expected, 0.02f) << x << ", " << y << ", step " << step;
        EXPECT_EQ(texel.x, 0);
      }
    }
  }
}

TEST_F(VolumesOnRoom, CompensationIsThePolynomial) {
  const Occluders occluders = this->occluders();
  VolumePass pass({.accessibility = Accessibility::bits32});
  const RayOptions options = options_of(1.0f, true);
  const std::vector<float> raw = draw(pass, occluders, g_buffer_->by_positions(), camera_, options);
  const glm::vec3 curves[] = {kFittedCompensation, {0.5f, 0.25f, -0.125f}, {3, 0, 0}, {-1, 0, 0}};
  for (const glm::vec3& curve : curves) {
    const std::vector<float> drawn =
        draw(pass, occluders, g_buffer_->by_positions(), camera_, options, {.compensation = curve});
    for (std::size_t i = 0; i < raw.size(); ++i) {
      const float o = raw[i], expected = curve.x * o + curve.y * o * o + curve.z * o * o * o;
      EXPECT_NEAR(drawn[i], std::clamp(expected, 0.0f, 1.0f), 2e-6f);
    }
  }
}

TEST_F(VolumesOnRoom, OfNothingAreNothing) {
  VolumePass pass;
  const Occluders none;
  for (const float value : draw(pass, none, g_buffer_->by_positions(), camera_, options_of(1, true))) {
    EXPECT_EQ(value, 0);
  }
  // Triangles without area or with a coordinate that is none take no part.
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Mesh bad = mesh_;
  const auto first = static_cast<unsigned>(bad.positions.size());
  bad.positions.insert(bad.positions.end(), {{0, 1, 0}, {0, 1, 0}, {1, 1, 0}, {nan, 1, 0}});
  bad.triangles.emplace_back(first, first + 1, first + 2);
  bad.triangles.emplace_back(first, first + 2, first + 3);
  const Occluders occluders(bad.positions, bad.triangles);
  const auto options = options_of(1, true);
  EXPECT_EQ(draw(pass, occluders, g_buffer_->by_positions(), camera_, options),
            draw(pass, this->occluders(), g_buffer_->by_positions(), camera_, options));
  // A camera that sees nothing.
  Camera away = camera_;
  away.view = glm::lookAt(glm::vec3(0, 0, 50), glm::vec3(0, 0, 90), glm::vec3(0, 1, 0));
  const GBufferPass sky(mesh_, away, kWidth, kHeight);
  for (const float value : draw(pass, occluders, sky.by_depth(), away, options)) EXPECT_EQ(value, -1);
}

TEST_F(VolumesOnRoom, TakeEverySize) {
  VolumePass pass({.accessibility = Accessibility::bits32});
  const Occluders occluders = this->occluders();
  const RayOptions options = options_of(0.2f, true);
  for (const auto& [width, height] :
       {std::pair{1, 1}, lkao::tests::unless_sanitized(std::pair{511, 383}, {127, 95}), {17, 3}}) {
    const Camera camera = room_camera(width, height);
    const GBufferPass g_buffer(mesh_, camera, width, height);
    const std::vector<float> drawn = draw(pass, occluders, g_buffer.by_positions(), camera, options);
    std::vector<VolumeReceiver> receivers = volume_receivers(mesh_, g_buffer.receivers(), options);
    // Of the large one, some pixels, the last among them.
    const std::size_t step = drawn.size() > 1000 ? 251 : 1;
    for (std::size_t i = drawn.size(); i > 0; i -= std::min(i, step)) {
      const VolumeReceiver& receiver = receivers[i - 1];
      const double right =
          receiver.normal == glm::dvec3(0) ? -1 : VolumeDefinition{0.2, true, true}.occlusion(mesh_, receiver);
      EXPECT_NEAR(static_cast<double>(drawn[i - 1]), std::min(right, 1.0), 0.02) << width << " x " << height;
    }
  }
}

}  // namespace
}  // namespace lkao::gl::tests::volumes_pass_test
