// Eq. 4 in GLSL, alone: closed forms, rays, and sums.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "gpu/gl/objects.h"
#include "gpu/gl/program.h"
#include "gpu/gl/shader_sources.h"
#include "gpu/on_software.h"
#include "gpu/volumes_definition.h"

namespace lkao::gl::tests::volumes_form_factor_test {
namespace {

using lkao::tests::random_direction;
using lkao::tests::random_point;
using lkao::tests::uniform;

constexpr double kPi = std::numbers::pi;

// A triangle as seen from the origin.
struct Seen {
  glm::vec4 a, b, c;
  glm::vec4 normal{0, 0, 1, 0}, up{0, 0, 1, 0};
};

class VolumesFormFactor : public OnSoftware {
 protected:
  static std::vector<float> find(const std::vector<Seen>& seen) {
    const std::string text = std::string("#version 450 core\n") + shader_source("volumes/form_factor") + R"(
      struct Seen { vec4 a, b, c, normal, up; };
      layout(local_size_x = 64) in;
      layout(std430, binding = 0) readonly buffer In { Seen seen[]; };
      layout(std430, binding = 1) writeonly buffer Out { float factors[]; };
      void main() {
        uint i = gl_GlobalInvocationID.x;
        if (i >= seen.length()) return;
        Polygon polygon = above(triangle_of(seen[i].a.xyz, seen[i].b.xyz, seen[i].c.xyz), seen[i].normal.xyz);
        if (polygon.count > 0 && seen[i].up != seen[i].normal) polygon = above(polygon, seen[i].up.xyz);
        factors[i] = form_factor(polygon, seen[i].normal.xyz);
      })";
    const ProgramObject program = make_program_of(GL_COMPUTE_SHADER, "the test", text);
    const Buffer in = make_buffer(static_cast<GLsizeiptr>(seen.size() * sizeof(Seen)), seen.data(), 0);
    const Buffer out = make_buffer(static_cast<GLsizeiptr>(seen.size() * 4), nullptr, 0);
    glUseProgram(program.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, in.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, out.name());
    glDispatchCompute(static_cast<GLuint>((seen.size() + 63) / 64), 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    std::vector<float> factors(seen.size());
    glGetNamedBufferSubData(out.name(), 0, static_cast<GLsizeiptr>(factors.size() * 4), factors.data());
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    glUseProgram(0);
    return factors;
  }

  static double find_sum(const std::vector<Seen>& seen) {
    double sum = 0;
    for (const float factor : find(seen)) sum += static_cast<double>(factor);
    return sum;
  }
};

Seen seen_of(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return {glm::vec4(a, 0), glm::vec4(b, 0), glm::vec4(c, 0)};
}

// Turned to face the origin: clockwise as seen from there.
Seen facing(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return glm::dot(glm::cross(b - a, c - a), a) < 0 ? seen_of(a, b, c) : seen_of(a, c, b);
}

void add_facing_quad(std::vector<Seen>& seen, const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
  seen.push_back(facing(corner, corner + u, corner + u + v));
  seen.push_back(facing(corner, corner + u + v, corner + v));
}

TEST_F(VolumesFormFactor, HasTheClosedForms) {
  const float sizes[] = {0.1f, 0.7f, 1.0f, 3.0f, 50.0f};
  for (const float x : sizes) {
    for (const float y : sizes) {
      const double a = x, b = y;
      // A rectangle a by b at the height 1, one corner over the receiver; and one on the horizon, square to the floor,
      // at the distance 1. E. g. J. Howell, "A Catalog of Radiation Heat Transfer Configuration Factors", B-3 and B-4.
      std::vector<Seen> over, upright;
      add_facing_quad(over, {0, 0, 1}, {x, 0, 0}, {0, y, 0});
      add_facing_quad(upright, {0, 1, 0}, {x, 0, 0}, {0, 0, y});
      const double ra = std::sqrt(1 + a * a), rb = std::sqrt(1 + b * b);
      EXPECT_NEAR(find_sum(over), (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb)) / (2 * kPi), 3e-6);
      EXPECT_NEAR(find_sum(upright), (std::atan(a) - std::atan(a / rb) / rb) / (2 * kPi), 3e-6);
    }
  }
  // A disk of radius r at the height h: r^2 / (r^2 + h^2).
  for (const float r : {0.05f, 1.0f, 20.0f}) {
    constexpr int kCount = 720;
    std::vector<Seen> disk;
    for (int i = 0; i < kCount; ++i) {
      const auto place = [&](int k) {
        const double turn = 2 * kPi * k / kCount;
        return glm::vec3(r * std::cos(turn), r * std::sin(turn), 1);
      };
      disk.push_back(facing({0, 0, 1}, place(i), place(i + 1)));
    }
    EXPECT_NEAR(find_sum(disk), static_cast<double>(r * r / (r * r + 1)), 5e-5) << r;
  }
}

// Of the directions of an even grid over the disk, lifted: the share that meets the triangle.
double share_of_rays(const Seen& seen) {
  constexpr int kSide = 1000;
  const glm::dvec3 n(seen.normal), up(seen.up), a(seen.a), b(seen.b), c(seen.c);
  const glm::dvec3 u = glm::normalize(std::fabs(n.x) < 0.6 ? glm::cross(n, glm::dvec3(1, 0, 0))
                                                           : glm::cross(n, glm::dvec3(0, 1, 0))),
                   v = glm::cross(n, u);
  const glm::dvec3 planes[3] = {glm::cross(b, a), glm::cross(c, b), glm::cross(a, c)};
  int ray_count = 0, hit_count = 0;
  for (int i = 0; i < kSide; ++i) {
    for (int k = 0; k < kSide; ++k) {
      const double x = (2.0 * i + 1) / kSide - 1, y = (2.0 * k + 1) / kSide - 1, z = 1 - x * x - y * y;
      if (z <= 0) continue;
      ++ray_count;
      const glm::dvec3 ray = x * u + y * v + std::sqrt(z) * n;
      hit_count += glm::dot(ray, up) > 0 && glm::dot(ray, planes[0]) > 0 && glm::dot(ray, planes[1]) > 0 &&
                   glm::dot(ray, planes[2]) > 0;
    }
  }
  return static_cast<double>(hit_count) / ray_count;
}

TEST_F(VolumesFormFactor, IsTheShareOfRays) {
  lut::RandomStream random(3);
  std::vector<Seen> seen;
  for (int i = 0; i < 40; ++i) {
    const glm::vec3 center = random_direction(random) * uniform(random, 0.2f, 2.0f);
    const auto corner = [&] { return center + random_point(random, i % 3 == 0 ? 3.0f : 0.8f); };
    Seen next = facing(corner(), corner(), corner());
    next.normal = glm::vec4(random_direction(random), 0);
    next.up = i % 2 == 0 ? next.normal
                         : glm::vec4(glm::normalize(glm::vec3(next.normal) + 0.8f * random_direction(random)), 0);
    seen.push_back(next);
  }
  const std::vector<float> factors = find(seen);
  double largest = 0;
  int partly_seen_count = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const double share = share_of_rays(seen[i]);
    EXPECT_NEAR(static_cast<double>(factors[i]), share, 1e-3) << i;
    largest = std::fmax(largest, std::fabs(static_cast<double>(factors[i]) - share));
    partly_seen_count += share > 0.01;
  }
  EXPECT_GT(partly_seen_count, 10);
  RecordProperty("largest_error", std::to_string(largest));
}

TEST_F(VolumesFormFactor, IsThatOfDoublePrecision) {
  lut::RandomStream random(4);
  std::vector<Seen> seen;
  for (int i = 0; i < 20000; ++i) {
    const float size = std::pow(10.0f, uniform(random, -2, 2));
    const glm::vec3 center = random_direction(random);
    Seen next = facing(center + random_point(random, size), center + random_point(random, size),
                       center + random_point(random, size));
    next.normal = glm::vec4(random_direction(random), 0);
    next.up = i % 2 == 0 ? next.normal : glm::vec4(random_direction(random), 0);
    seen.push_back(next);
  }
  const std::vector<float> factors = find(seen);
  double largest = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const double right = form_factor({seen[i].a, seen[i].b, seen[i].c}, {glm::dvec3(0), seen[i].normal, seen[i].up});
    largest = std::fmax(largest, std::fabs(static_cast<double>(factors[i]) - right));
  }
  EXPECT_LT(largest, 5e-5);
  RecordProperty("largest_error", std::to_string(largest));
}

TEST_F(VolumesFormFactor, KeepsItsDigitsFarAway) {
  // 1 by 1 at a hundred times the distance: cos cos / (pi d^2). The arc cosine of floats has none left.
  for (const float distance : {10.0f, 100.0f}) {
    std::vector<Seen> seen;
    const glm::vec3 place = distance * glm::normalize(glm::vec3(1, 2, 3));
    add_facing_quad(seen, place - glm::vec3(0.5f, 0.5f, 0), {1, 0, 0}, {0, 1, 0});
    const double cosine = 3 / std::sqrt(14.0), d = distance;
    const double right = cosine * cosine / (kPi * d * d);
    EXPECT_NEAR(find_sum(seen) / right, 1, 5e-3) << distance;
  }
}

TEST_F(VolumesFormFactor, OfAllAroundIsWhatBothHorizonsLeave) {
  // A box around the receiver covers all that it sees: (1 + cos) / 2 of the shading hemisphere.
  for (const float lean : {0.0f, 0.3f, 1.2f, 2.5f}) {
    std::vector<Seen> seen;
    for (int axis = 0; axis < 3; ++axis) {
      for (const float side : {-1.0f, 1.0f}) {
        glm::vec3 corner(-1, -1, -1), u(0), v(0);
        corner[axis] = side;
        u[(axis + 1) % 3] = v[(axis + 2) % 3] = 2;
        add_facing_quad(seen, corner + glm::vec3(0.1f, -0.2f, 0.3f), u, v);
      }
    }
    for (Seen& one : seen) {
      one.normal = glm::vec4(glm::normalize(glm::vec3(1, 2, 2)), 0);
      const glm::vec3 across = glm::normalize(glm::cross(glm::vec3(one.normal), glm::vec3(0, 1, 1)));
      one.up = std::cos(lean) * one.normal + std::sin(lean) * glm::vec4(across, 0);
    }
    EXPECT_NEAR(find_sum(seen), 0.5 + 0.5 * std::cos(static_cast<double>(lean)), 2e-6) << lean;
  }
}

TEST_F(VolumesFormFactor, OfWhatTheHorizonHidesIsNothing) {
  std::vector<Seen> seen = {seen_of({-1, -1, -0.1f}, {0, 2, -0.1f}, {1, -1, -0.1f}),  // below
                            seen_of({-1, -1, 0}, {0, 2, 0}, {1, -1, 0})};             // in the plane, around
  for (const float factor : find(seen)) EXPECT_EQ(factor, 0);
  const Seen front = facing({-1, 1, 0.5f}, {1, 1, 0.5f}, {0, 1, 2});
  EXPECT_GT(find({front})[0], 0.05f);
  EXPECT_FLOAT_EQ(find({{front.a, front.c, front.b}})[0], -find({front})[0]) << "the other way round";
}

}  // namespace
}  // namespace lkao::gl::tests::volumes_form_factor_test
