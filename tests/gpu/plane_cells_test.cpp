// The cell arithmetic in GLSL is that of lut/plane_cells.h.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "gpu/gl/program.h"
#include "gpu/gl/shader_sources.h"
#include "gpu/gl/uniform_buffer.h"
#include "gpu/masks/table_buffer.h"
#include "gpu/on_software.h"
#include "support/meshes.h"
#include "support/sanitized.h"

namespace lkao::gl::tests::plane_cells_test {
namespace {

constexpr const char* kMain = R"(
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Planes { vec4 planes[]; };
layout(std430, binding = 1) writeonly buffer Cells { uvec2 cells[]; };
void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i < planes.length()) cells[i] = uvec2(plane_cell(planes[i].xyz, planes[i].w), edge_cell(planes[i].xyz));
})";

// Random planes, and those at the seams of cube maps: along axes and diagonals, and next to them.
std::vector<glm::vec4> make_planes(int count) {
  std::vector<glm::vec4> planes;
  lut::RandomStream random(1);
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        for (int i = 0; i < 50; ++i) {
          const glm::vec3 near = 1e-6f * static_cast<float>(i) * lkao::tests::random_direction(random);
          planes.emplace_back(glm::normalize(glm::vec3(x, y, z) + near), 0.02f * static_cast<float>(i));
        }
      }
    }
  }
  while (planes.size() < static_cast<std::size_t>(count)) {
    planes.emplace_back(lkao::tests::random_direction(random), lkao::tests::uniform(random, -0.01f, 1.02f));
  }
  return planes;
}

class PlaneCellsInGlsl : public OnSoftware {
 protected:
  static std::vector<glm::uvec2> run(const TableBuffer& table, const std::vector<glm::vec4>& planes) {
    const std::string text = "#version 450 core\n#define LKAO_CUBE_ADDRESSING " + std::to_string(table.is_cube()) +
                             "\n" + shader_source("masks/plane_cells") + kMain;
    const ProgramObject program = make_program_of(GL_COMPUTE_SHADER, "the test", text);
    MaskPassBlock block{};
    table.describe(block);
    const UniformBuffer<MaskPassBlock> block_buffer;
    const Buffer plane_buffer = make_buffer(static_cast<GLsizeiptr>(planes.size() * 16), planes.data(), 0);
    const Buffer cell_buffer = make_buffer(static_cast<GLsizeiptr>(planes.size() * 8), nullptr, 0);
    glUseProgram(program.name());
    block_buffer.set_and_bind(block);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, plane_buffer.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, cell_buffer.name());
    glDispatchCompute(static_cast<GLuint>((planes.size() + 63) / 64), 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    std::vector<glm::uvec2> cells(planes.size());
    glGetNamedBufferSubData(cell_buffer.name(), 0, static_cast<GLsizeiptr>(cells.size() * 8), cells.data());
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    return cells;
  }
};

TEST_F(PlaneCellsInGlsl, AreThoseOfTheCpuForAMillionPlanes) {
  const std::vector<glm::vec4> planes = make_planes(lkao::tests::unless_sanitized(1'000'000, 50'000));
  for (const PlaneAddressing addressing : {PlaneAddressing::cube, PlaneAddressing::slices}) {
    for (const int resolution : {32, 61, 128}) {
      SCOPED_TRACE(testing::Message() << "resolution " << resolution);
      const PlaneMaskTable table(SamplePattern::standard(64), {resolution, addressing, PlaneMasks::nearest});
      const std::vector<glm::uvec2> cells = run(TableBuffer(table), planes);
      std::size_t difference_count = 0;
      for (std::size_t i = 0; i < planes.size(); ++i) {
        const glm::vec3 normal(planes[i]);
        difference_count += cells[i] != glm::uvec2(table.cell(normal, planes[i].w), table.edge_cell(normal));
      }
      // GLSL's division may be off by 2.5 units in the last place, and is on GPUs.
      EXPECT_LE(difference_count, context_->is_software() ? 0u : 20u);
    }
  }
}

}  // namespace
}  // namespace lkao::gl::tests::plane_cells_test
