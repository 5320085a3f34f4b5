// C++ and GLSL lay out the uniform blocks in the same way.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "gpu/frame/target_block.h"
#include "gpu/frame/view_block.h"
#include "gpu/gl/program.h"
#include "gpu/masks/mask_pass_block.h"
#include "gpu/mesh/shapes_block.h"
#include "gpu/on_software.h"
#include "gpu/screen/alchemy/alchemy_block.h"
#include "gpu/screen/filter_block.h"
#include "gpu/screen/horizon/horizon_block.h"
#include "gpu/screen/splat/splat_block.h"
#include "gpu/screen/vao/vao_block.h"
#include "gpu/volumes/volume_pass_block.h"

namespace lkao::gl::tests::uniform_blocks_test {
namespace {

GLint value_of(GLuint program, GLenum interface, GLuint index, GLenum property) {
  GLint value = -1;
  glGetProgramResourceiv(program, interface, index, 1, &property, 1, nullptr, &value);
  return value;
}

// Where the driver has a member of a block, such as "ViewBlock.width"; -1 where no shader reads it.
GLint offset_of(const ProgramObject& program, const std::string& member) {
  const GLuint index = glGetProgramResourceIndex(program.name(), GL_UNIFORM, member.c_str());
  return index == GL_INVALID_INDEX ? -1 : value_of(program.name(), GL_UNIFORM, index, GL_OFFSET);
}

GLint size_of(const ProgramObject& program, const char* block) {
  const GLuint index = glGetProgramResourceIndex(program.name(), GL_UNIFORM_BLOCK, block);
  return index == GL_INVALID_INDEX ? -1 : value_of(program.name(), GL_UNIFORM_BLOCK, index, GL_BUFFER_DATA_SIZE);
}

class UniformBlocks : public OnSoftware {};

#define LKAO_EXPECT_OFFSET(PROGRAM, BLOCK, MEMBER) \
  EXPECT_EQ(offset_of(PROGRAM, #BLOCK "." #MEMBER), static_cast<GLint>(offsetof(BLOCK, MEMBER)))

TEST_F(UniformBlocks, AreLaidOutAlike) {
  const ProgramObject receivers = make_program({"masks/receivers.comp"});
  EXPECT_EQ(size_of(receivers, "ViewBlock"), static_cast<GLint>(sizeof(ViewBlock)));
  LKAO_EXPECT_OFFSET(receivers, ViewBlock, world_from_clip);
  LKAO_EXPECT_OFFSET(receivers, ViewBlock, world_from_normals);
  LKAO_EXPECT_OFFSET(receivers, ViewBlock, view_depth);
  LKAO_EXPECT_OFFSET(receivers, ViewBlock, width);
  LKAO_EXPECT_OFFSET(receivers, ViewBlock, has_unorm_geometric_normals);

  const ProgramObject shapes = make_program({"mesh/prism.vert", "mesh/coverage.frag"});
  EXPECT_EQ(size_of(shapes, "ShapesBlock"), static_cast<GLint>(sizeof(ShapesBlock)));
  LKAO_EXPECT_OFFSET(shapes, ShapesBlock, clip_from_world);
  LKAO_EXPECT_OFFSET(shapes, ShapesBlock, radius);
  LKAO_EXPECT_OFFSET(shapes, ShapesBlock, depth_far);
  LKAO_EXPECT_OFFSET(shapes, ShapesBlock, has_ranges);
  LKAO_EXPECT_OFFSET(shapes, ViewBlock, pixel_size);

  const ProgramObject resolve = make_program({"masks/resolve.comp"});
  EXPECT_EQ(size_of(resolve, "MaskPassBlock"), static_cast<GLint>(sizeof(MaskPassBlock)));
  LKAO_EXPECT_OFFSET(resolve, MaskPassBlock, ray_count);
  LKAO_EXPECT_OFFSET(resolve, MaskPassBlock, jitter_tilt);
  LKAO_EXPECT_OFFSET(resolve, MaskPassBlock, writes_bent_normals);
  EXPECT_EQ(size_of(resolve, "TargetBlock"), static_cast<GLint>(sizeof(TargetBlock)));
  LKAO_EXPECT_OFFSET(resolve, TargetBlock, steps);
  LKAO_EXPECT_OFFSET(resolve, TargetBlock, first_x);
  LKAO_EXPECT_OFFSET(resolve, TargetBlock, background);

  const ProgramObject classify = make_program({"mesh/classify.comp"});
  LKAO_EXPECT_OFFSET(classify, ShapesBlock, reach);
  LKAO_EXPECT_OFFSET(classify, ShapesBlock, has_opacities);

  const ProgramObject volumes = make_program({"volumes/resolve.comp"});
  EXPECT_EQ(size_of(volumes, "VolumePassBlock"), static_cast<GLint>(sizeof(VolumePassBlock)));
  LKAO_EXPECT_OFFSET(volumes, VolumePassBlock, compensation);

  const ProgramObject splats = make_program({"screen/splat/near.comp"});
  EXPECT_EQ(size_of(splats, "SplatBlock"), static_cast<GLint>(sizeof(SplatBlock)));
  LKAO_EXPECT_OFFSET(splats, SplatBlock, near_radius);
  LKAO_EXPECT_OFFSET(splats, SplatBlock, scale);

  const ProgramObject alchemy = make_program({"screen/alchemy/obscurance.comp"});
  EXPECT_EQ(size_of(alchemy, "AlchemyBlock"), static_cast<GLint>(sizeof(AlchemyBlock)));
  LKAO_EXPECT_OFFSET(alchemy, AlchemyBlock, contrast);
  LKAO_EXPECT_OFFSET(alchemy, AlchemyBlock, seed);

  const ProgramObject vao = make_program({"screen/vao/vao.comp"}, {{"LKAO_COUNT", 0}});
  EXPECT_EQ(size_of(vao, "VaoBlock"), static_cast<GLint>(sizeof(VaoBlock)));
  LKAO_EXPECT_OFFSET(vao, VaoBlock, line_first);
  LKAO_EXPECT_OFFSET(vao, VaoBlock, ball_radius);
  LKAO_EXPECT_OFFSET(vao, VaoBlock, bleeding_y);
  for (const int is_bitmask : {0, 1}) {
    const ProgramObject horizons = make_program({"screen/horizon/horizon.comp"}, {{"LKAO_BITMASK", is_bitmask}});
    EXPECT_EQ(size_of(horizons, "HorizonBlock"), static_cast<GLint>(sizeof(HorizonBlock)));
    LKAO_EXPECT_OFFSET(horizons, HorizonBlock, step_exponent);
    LKAO_EXPECT_OFFSET(horizons, HorizonBlock, seed);
  }

  const ProgramObject filter = make_program({"screen/bilateral.comp"});
  EXPECT_EQ(size_of(filter, "FilterBlock"), static_cast<GLint>(sizeof(FilterBlock)));
  LKAO_EXPECT_OFFSET(filter, FilterBlock, gauss);
  LKAO_EXPECT_OFFSET(filter, FilterBlock, normal_sharpness);
  LKAO_EXPECT_OFFSET(filter, ViewBlock, view_from_clip);
  LKAO_EXPECT_OFFSET(filter, ViewBlock, view_from_world);
}

}  // namespace
}  // namespace lkao::gl::tests::uniform_blocks_test
