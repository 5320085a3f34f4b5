// A program built without OpenGL says so.
#include "cli/program.h"

namespace lkao::test {
namespace {

class NoRaster : public ProgramTest {};

TEST_F(NoRaster, TheMethodIsRefused) {
  expect_rejected({"render", "builtin:wall", "--radius", "1", "-o", path("out.exr"), "--method", "raster"},
                  {"--method raster", "built without OpenGL"});
}

}  // namespace
}  // namespace lkao::test
