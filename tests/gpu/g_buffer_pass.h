// A G-buffer as a renderer makes it: the mesh drawn with a depth test into depth, positions and normals.
#pragma once

#include <vector>

#include <glm/geometric.hpp>

#include "gpu/gl/objects.h"
#include "lkao/ambient_occlusion.h"
#include "lkao/gl.h"
#include "support/meshes.h"

namespace lkao::gl::tests {

using lkao::tests::Mesh;

struct GBufferFormats {
  GLenum depth = GL_DEPTH_COMPONENT32F, linear_depth = GL_R32F, positions = GL_RGBA32F, normals = GL_RGBA32F;
};

// Of a triangle, its normal on the side of `towards`.
struct FacePlane {
  FacePlane(const Mesh& mesh, int face, const glm::vec3& towards);
  double height_of(const glm::vec3& point) const { return glm::dot(normal, glm::dvec3(point) - corner); }

  glm::dvec3 corner, normal;
};

class GBufferPass {
 public:
  // Normals are those of the triangles, turned towards the camera.
  GBufferPass(const Mesh& mesh, const Camera& camera, int width, int height, const GBufferFormats& formats = {});

  // With one texture each to tell positions.
  GBuffer by_positions() const;
  GBuffer by_view_positions() const;
  GBuffer by_depth() const;
  GBuffer by_linear_depth() const;

  int width() const { return width_; }
  int height() const { return height_; }
  GLuint normals() const { return normals_.name(); }
  GLuint depth() const { return depth_.name(); }
  // The pixels as receivers of the CPU's query; those that show nothing have no normal.
  std::vector<Receiver> receivers() const;
  // The triangle that each pixel shows; -1 where none is.
  std::vector<int> faces() const;
  // The receivers, to the last bit on those triangles. Needs positions of 32-bit floats.
  std::vector<Receiver> exact_receivers(const Mesh& mesh) const;

 private:
  int width_, height_;
  Texture depth_, linear_depth_, positions_, view_positions_, normals_, faces_;
};

// A texture of the given format, with pixels of RGBA floats, filters as OpenGL has them by default.
Texture make_image(GLenum format, int width, int height, const float* rgba = nullptr);
std::vector<glm::vec4> read_image(GLuint texture, int width, int height);

}  // namespace lkao::gl::tests
