// Normals of every format and encoding, against exact ones: how far they turn, and what that does to occlusion.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "gpu/in_furnished_room.h"
#include "support/sanitized.h"

namespace lkao::gl::tests::normals_test {
namespace {

constexpr int kWidth = lkao::tests::unless_sanitized(96, 64);
constexpr int kHeight = lkao::tests::unless_sanitized(72, 48);

struct Format {
  const char* name;
  GLenum format;
  bool is_unsigned;
  NormalEncoding encoding;
  double largest_angle;  // in degrees
};

// Of octahedral ones in 8 and 16 bits Cigolle et al. 2014, Table 2, have at most 0.94 and 0.0036 degrees.
const Format kFormats[] = {{"RGBA32F", GL_RGBA32F, false, NormalEncoding::xyz, 1e-4},
                           {"RGBA16F", GL_RGBA16F, false, NormalEncoding::xyz, 0.05},
                           {"RGBA16_SNORM", GL_RGBA16_SNORM, false, NormalEncoding::xyz, 0.002},
                           {"RGBA8_SNORM", GL_RGBA8_SNORM, false, NormalEncoding::xyz, 0.5},
                           {"RGB10_A2", GL_RGB10_A2, true, NormalEncoding::xyz, 0.12},
                           {"RGBA8", GL_RGBA8, true, NormalEncoding::xyz, 0.5},
                           {"octahedral RG8", GL_RG8, true, NormalEncoding::octahedral, 0.95},
                           {"octahedral RG8_SNORM", GL_RG8_SNORM, false, NormalEncoding::octahedral, 0.95},
                           {"octahedral RG16", GL_RG16, true, NormalEncoding::octahedral, 0.004},
                           {"octahedral RG16_SNORM", GL_RG16_SNORM, false, NormalEncoding::octahedral, 0.004},
                           {"octahedral RG16F", GL_RG16F, false, NormalEncoding::octahedral, 0.13},
                           {"xy RG8", GL_RG8, true, NormalEncoding::xy, 8},
                           {"xy RG8_SNORM", GL_RG8_SNORM, false, NormalEncoding::xy, 8},
                           {"xy RG16", GL_RG16, true, NormalEncoding::xy, 0.5},
                           {"xy RG16_SNORM", GL_RG16_SNORM, false, NormalEncoding::xy, 0.5},
                           {"xy RG16F", GL_RG16F, false, NormalEncoding::xy, 3}};

glm::vec3 encode(const glm::vec3& normal, NormalEncoding encoding) {
  if (encoding == NormalEncoding::xyz) return normal;
  if (encoding == NormalEncoding::xy) return {normal.x, normal.y, 0};
  const glm::vec3 n = normal / (std::fabs(normal.x) + std::fabs(normal.y) + std::fabs(normal.z));
  if (n.z >= 0) return {n.x, n.y, 0};
  return {std::copysign(1 - std::fabs(n.y), n.x), std::copysign(1 - std::fabs(n.x), n.y), 0};
}

class Normals : public InFurnishedRoom<kWidth, kHeight> {
 protected:
  // Of unit vectors in view space.
  static Texture make_normals(const Format& format, const std::vector<glm::vec3>& normals) {
    std::vector<glm::vec4> texels;
    for (const glm::vec3& normal : normals) {
      const glm::vec3 encoded = normal == glm::vec3(0) ? normal : encode(normal, format.encoding);
      texels.emplace_back(format.is_unsigned ? 0.5f * encoded + 0.5f : encoded, 0);
    }
    return make_image(format.format, kWidth, kHeight, &texels[0].x);
  }
  GBuffer with(const Texture& normals, const Format& format) const {
    GBuffer textures = g_buffer_->by_positions();
    textures.normals = normals.name();
    textures.normal_space = NormalSpace::view;
    textures.normal_encoding = format.encoding;
    return textures;
  }
};

TEST_F(Normals, OfAllFormatsTurnAsLittleAsTheyMay) {
  PassOnMesh pass = make_pass(mesh_, PlaneMaskTable(SamplePattern::standard(64), {32, {}, PlaneMasks::nearest}));
  const glm::dmat3 view(camera_.view);
  lut::RandomStream random(3);
  for (const Format& format : kFormats) {
    SCOPED_TRACE(format.name);
    std::vector<glm::vec3> normals;
    for (int i = 0; i < kWidth * kHeight; ++i) {
      glm::vec3 normal = lkao::tests::random_direction(random);
      if (i < 6) normal = glm::vec3(0), normal[i % 3] = i < 3 ? 1.0f : -1.0f;
      if (format.encoding == NormalEncoding::xy) normal.z = std::fabs(normal.z);
      normals.push_back(normal);
    }
    const Texture texture = make_normals(format, normals);
    pass.draw(with(texture, format), camera_, {.radius = 0.01f});
    const std::vector<PixelReceiver> seen = pass.read_receivers();
    double largest = 0, sum = 0, count = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (!seen[i].is_valid) continue;
      const double sine = glm::length(glm::cross(view * glm::dvec3(seen[i].up), glm::dvec3(normals[i])));
      const double cosine = glm::dot(view * glm::dvec3(seen[i].up), glm::dvec3(normals[i]));
      const double angle = std::atan2(sine, cosine) * 57.29577951308232;
      largest = std::max(largest, angle);
      sum += angle;
      ++count;
    }
    EXPECT_GT(count, kWidth * kHeight / 2);
    // Where numbers are cut off in storing, not rounded: up to twice as much a component.
    EXPECT_LT(largest, (context_->is_software() ? 1.0 : 2.5) * format.largest_angle);
    RecordProperty(format.name, fmt::format("at most {:.2g}, mean {:.2g} degrees", largest, sum / count));
  }
}

TEST_F(Normals, OfAllFormatsGiveNearlyTheSameOcclusion) {
  PassOnMesh pass = make_pass(mesh_, PlaneMaskTable(SamplePattern::standard(64), {.resolution = 32}));
  std::vector<glm::vec3> normals;
  for (const Receiver& receiver : g_buffer_->receivers()) {
    const float length = glm::length(receiver.normal);
    normals.push_back(length > 0 ? glm::mat3(camera_.view) * (receiver.normal / length) : glm::vec3(0));
  }
  const RayOptions options{.radius = 0.5f};
  std::vector<std::uint64_t> expected;
  for (const Format& format : kFormats) {
    SCOPED_TRACE(format.name);
    const Texture texture = make_normals(format, normals);
    pass.draw_off_surface(with(texture, format), camera_, options);
    const std::vector<std::uint64_t> masks = pass.read_masks();
    if (expected.empty()) expected = masks;
    double sum = 0;
    for (std::size_t i = 0; i < masks.size(); ++i) {
      sum += std::abs(std::popcount(masks[i]) - std::popcount(expected[i])) / 64.0;
    }
    const double mean = sum / static_cast<double>(masks.size());
    RecordProperty(format.name, fmt::format("mean error {:.2f}/255", 255 * mean));
    // A normal of another last bit may turn the pattern, so that even the best cast other rays here and there.
    EXPECT_LT(mean, (format.encoding == NormalEncoding::xy ? 1.5 : 0.6) / 255);
  }
  EXPECT_GT(count_bits(expected), 2 * expected.size());
}

}  // namespace
}  // namespace lkao::gl::tests::normals_test
