// Scenes far from zero, as surveys have them: the place on the globe must not matter.
#include <cmath>

#include <fmt/format.h>
#include <glm/vec3.hpp>

#include "cli/program.h"
#include "image/image.h"
#include "image/metrics.h"

namespace lkao::test {
namespace {

const glm::dvec3 kZone(448262.37, 5413678.11, 112.5);

// A floor, a table over it and a wall, in centimetres, z up, moved by `offset`.
std::string room_ply(const glm::dvec3& offset) {
  const glm::dvec3 corners[] = {{-1.03, -1, 0},       {1, -1.07, 0},      {1, 1, 0},         {-1, 1, 0},
                                {-0.41, -0.39, 0.31}, {0.4, -0.41, 0.31}, {0.4, 0.43, 0.31}, {-0.37, 0.4, 0.31},
                                {1, 1, 0.73},         {-1, 1, 0.69}};
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 10\nproperty double x\nproperty double y\nproperty double z\n"
      "element face 6\nproperty list uchar int vertex_indices\nend_header\n";
  for (const glm::dvec3& corner : corners) {
    const glm::dvec3 p = corner + offset;
    text += fmt::format("{:.2f} {:.2f} {:.2f}\n", p.x, p.y, p.z);
  }
  return text + "3 0 1 2\n3 0 2 3\n3 4 5 6\n3 4 6 7\n3 3 2 8\n3 3 8 9\n";
}

std::string place(const glm::dvec3& p) { return fmt::format("{:.9g},{:.9g},{:.9g}", p.x, p.y, p.z); }

class Far : public ProgramTest {
 protected:
  std::string room(const std::string& name, const glm::dvec3& offset) const {
    return write_file(name, room_ply(offset));
  }

  // Renders the room at an offset with a camera that moved along; returns what stood on stderr.
  std::string render(const glm::dvec3& offset, const std::string& name, const Arguments& more = {}) const {
    Arguments arguments = {"render",
                           room("room.ply", offset),
                           "-o",
                           path(name),
                           "--size",
                           "48x36",
                           "--radius",
                           "0.8",
                           "--samples",
                           "128",
                           "--up",
                           "0,0,1",
                           "--eye",
                           place(offset + glm::dvec3(1.5, -2.25, 1.75)),
                           "--target",
                           place(offset + glm::dvec3(0, 0.25, 0.125)),
                           "--reference",
                           "--json",
                           path("out.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = run_program(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(read_json("out.json")["reference"]["mismatched_rays"], 0);
    return result.err;
  }
};

TEST_F(Far, TheImageIsThatAtZero) {
  EXPECT_EQ(render({}, "near.exr"), "");
  const std::string err = render(kZone, "far.exr");
  EXPECT_EQ(err, "lkao: " + path("room.ply") + ": positions are taken relative to (448260, 5413680, 110)\n");
  const std::vector<float> near = image::read_image(path("near.exr")).pixels;
  const std::vector<float> far = image::read_image(path("far.exr")).pixels;
  const image::Metrics metrics = image::compare(near, far);
  EXPECT_LT(metrics.mae, 1e-3);
  EXPECT_LT(metrics.max_error, 0.1);
  EXPECT_GT(*std::max_element(near.begin(), near.end()), 0.5f);  // there is something to see
}

TEST_F(Far, TheCameraIsToldInTheFilesCoordinates) {
  render(kZone, "far.exr");
  const nlohmann::json json = read_json("out.json");
  const glm::dvec3 eye = kZone + glm::dvec3(1.5, -2.25, 1.75);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(json["camera"]["eye"][static_cast<std::size_t>(axis)], eye[axis], 1e-5);
  }
  EXPECT_EQ(json["origin"], nlohmann::json({448260.0, 5413680.0, 110.0}));
}

TEST_F(Far, FramingSeesTheWholeScene) {
  const auto seen = [&](const glm::dvec3& offset) {
    const ProgramResult result = run_program({"render", room("room.ply", offset), "-o", path("a.exr"), "--size",
                                              "48x36", "--radius", "5%", "--up", "0,0,1", "--json", path("out.json")});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return read_json("out.json");
  };
  const nlohmann::json near = seen({}), far = seen(kZone);
  EXPECT_NEAR(far["receivers"].get<double>(), near["receivers"].get<double>(), 8);
  EXPECT_NEAR(far["radius"].get<double>(), near["radius"].get<double>(), 1e-6);
}

TEST_F(Far, InfoTellsTheBoxInTheFilesCoordinates) {
  const std::string scene = room("room.ply", kZone);
  const ProgramResult result = run_program({"info", scene, "--json", path("out.json")});
  const nlohmann::json json = read_json("out.json");
  const glm::dvec3 lower = kZone + glm::dvec3(-1.03, -1.07, 0), upper = kZone + glm::dvec3(1, 1, 0.73);
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    EXPECT_NEAR(json["bounds"]["lower"][i], lower[axis], 1e-5);
    EXPECT_NEAR(json["bounds"]["upper"][i], upper[axis], 1e-5);
  }
  EXPECT_EQ(json["origin"], nlohmann::json({448260.0, 5413680.0, 110.0}));
  for (const char* row :
       {"(448261.34, 5413677.04, 112.5) .. (448263.37, 5413679.11, 113.23)", "origin", "(448260, 5413680, 110)"}) {
    EXPECT_NE(result.out.find(row), std::string::npos) << row << "\n" << result.out;
  }
}

TEST_F(Far, BlockersAreInTheSameCoordinates) {
  const std::string roof =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
      "property double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const auto occlusion = [&](const glm::dvec3& offset) {
    std::string text = roof;
    for (const glm::dvec3& corner : {glm::dvec3(-9, -9, 0.4), glm::dvec3(9, -9, 0.4), glm::dvec3(0, 9, 0.4)}) {
      text += place(corner + offset) + "\n";
    }
    for (char& c : text) c = c == ',' ? ' ' : c;
    render(offset, "a.exr", {"--blockers", write_file("roof.ply", text + "3 0 1 2\n")});
    return read_json("out.json")["occlusion_mean"].get<double>();
  };
  const double near = occlusion({});
  EXPECT_GT(near, 0.3);
  EXPECT_NEAR(occlusion(kZone), near, 1e-3);
}

}  // namespace
}  // namespace lkao::test
