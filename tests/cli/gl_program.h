// Tests of methods that the program draws by OpenGL on the CPU.
#pragma once

#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>

#include "cli/program.h"
#include "cli/small_mesh.h"
#include "lkao/gl.h"
#include "raster/small_scene.h"

namespace lkao::test {

// The program, too, then draws in one thread: llvmpipe's own stop LeakSanitizer now and then.
inline const int kIsWithoutThreads = setenv("LP_NUM_THREADS", "0", 0);

// Looks at a small scene.
class GlProgramTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    try {
      software_ = std::make_unique<gl::HeadlessContext>(gl::Device::software);
    } catch (const std::runtime_error& error) {
      GTEST_SKIP() << "OpenGL is NOT tested on this machine: " << error.what() << "; install libgl1-mesa-dri";
    }
    const scene::Mesh mesh = raster::tests::small_scene();
    scene_ = write_file("small.ply", ply_bytes(mesh.positions, mesh.triangles));
  }

  // A rendering of it to NAME.exr and NAME.json; `more` may hold options of any method.
  Arguments render_small_scene(const std::string& method, const std::string& size, const std::string& name,
                               const Arguments& more) const {
    Arguments arguments = {"render",   scene_,
                           "--method", method,
                           "--size",   size,
                           "--radius", "0.5",
                           "--eye",    "1.2,1.8,2.4",
                           "--target", "0.05,0.45,-0.1",
                           "--up",     "0.15,1,0",
                           "--fov",    "62",
                           "-o",       path(name + ".exr"),
                           "--json",   path(name + ".json")};
    if (method != "bvh" && method != "embree") arguments.insert(arguments.end(), {"--gl", "software"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  std::string scene_;
  std::unique_ptr<gl::HeadlessContext> software_;
};

}  // namespace lkao::test
