// What the tests of the glTF reader ask of it.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scene/formats/readers.h"
#include "scene/gltf_builder.h"

namespace lkao::scene {

inline FileMesh read(const GltfBuilder& builder) { return read_gltf("", builder.gltf()); }

// What the reader says of bytes that it must refuse.
inline std::string refusal(const std::string& bytes) {
  try {
    const FileMesh mesh = read_gltf("", bytes);
    ADD_FAILURE() << "taken, with " << mesh.triangles.size() << " triangles";
    return "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}
inline std::string refusal(const GltfBuilder& builder) { return refusal(builder.gltf()); }

// Expects a refusal that contains `fault` where the document has `value` at that JSON pointer.
inline void expect_refused_with(GltfBuilder builder, const std::string& pointer, const nlohmann::json& value,
                                const std::string& fault) {
  builder.document[nlohmann::json::json_pointer(pointer)] = value;
  const std::string message = refusal(builder);
  EXPECT_NE(message.find(fault), std::string::npos) << pointer << ": " << message << " / " << fault;
}

inline std::vector<glm::dvec3> corners(const FileMesh& mesh, std::size_t triangle) {
  const glm::uvec3& t = mesh.triangles.at(triangle);
  return {mesh.positions.at(t.x), mesh.positions.at(t.y), mesh.positions.at(t.z)};
}

// Twice its area long, to where the triangle's front looks.
inline glm::dvec3 front(const FileMesh& mesh, std::size_t triangle) {
  const std::vector<glm::dvec3> p = corners(mesh, triangle);
  return glm::cross(p[1] - p[0], p[2] - p[0]);
}

// Positive where the fronts of a closed mesh are outside.
inline double volume(const FileMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    sum += glm::dot(corners(mesh, t)[0], front(mesh, t)) / 6;
  }
  return sum;
}

// Around the corners of all triangles.
inline void expect_box(const FileMesh& mesh, const glm::dvec3& lower, const glm::dvec3& upper,
                       double tolerance = 1e-6) {
  glm::dvec3 low(1e300), high(-1e300);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const glm::dvec3& p : corners(mesh, t)) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(low[axis], lower[axis], tolerance) << "lower, axis " << axis;
    EXPECT_NEAR(high[axis], upper[axis], tolerance) << "upper, axis " << axis;
  }
}

}  // namespace lkao::scene
