#include <cmath>
#include <limits>
#include <set>

#include "cli/program.h"
#include "image/image.h"

namespace lkao::test {
namespace {

class Compare : public ProgramTest {
 protected:
  std::string write(const std::string& name, std::vector<std::string> channels, std::vector<float> pixels,
                    int width = 2) const {
    const int height = static_cast<int>(pixels.size() / channels.size()) / width;
    image::write_image(path(name), {width, height, std::move(channels), std::move(pixels)});
    return path(name);
  }
  nlohmann::json metrics(const std::string& a, const std::string& b) const {
    return nlohmann::json::parse(expect_success({"compare", a, b, "--json", "-"}).out);
  }
};

TEST_F(Compare, EqualImagesHaveNoError) {
  const std::string a = write("a.exr", {"occlusion"}, {0, 0.25f, 0.5f, 1});
  const nlohmann::json json = metrics(a, a);
  for (const char* key : {"mae", "rmse", "max_error"}) EXPECT_EQ(json[key], 0) << key;
  EXPECT_TRUE(json["psnr"].is_null());  // infinite
  EXPECT_EQ(json["equal_8bit_share"], 1);
  EXPECT_EQ(run_program({"compare", a, a, "--max-rmse", "0"}).exit_code, 0);
}

TEST_F(Compare, MeasuresWhatItShould) {
  const std::string a = write("a.exr", {"occlusion"}, {0, 0, 0, 0});
  const std::string b = write("b.exr", {"occlusion"}, {0.5f, 0, 0, 0});
  const nlohmann::json json = metrics(a, b);
  EXPECT_DOUBLE_EQ(json["mae"], 0.125);
  EXPECT_DOUBLE_EQ(json["rmse"], 0.25);
  EXPECT_DOUBLE_EQ(json["max_error"], 0.5);
  EXPECT_NEAR(json["psnr"], 20 * std::log10(4), 1e-9);
  EXPECT_EQ(json["equal_8bit_share"], 0.75);
}

TEST_F(Compare, ExitCodeTellsWhetherTheLimitIsKept) {
  const std::string a = write("a.exr", {"occlusion"}, {0, 0, 0, 0});
  const std::string b = write("b.exr", {"occlusion"}, {0.5f, 0, 0, 0});
  EXPECT_EQ(run_program({"compare", a, b, "--max-rmse", "0.25"}).exit_code, 0);
  const ProgramResult over = run_program({"compare", a, b, "--max-rmse", "0.2499", "--json", path("out.json")});
  EXPECT_EQ(over.exit_code, 1);
  EXPECT_EQ(over.err, "lkao: RMSE 0.25 is above --max-rmse 0.2499\n");
  EXPECT_EQ(read_json("out.json")["rmse"], 0.25);
}

TEST_F(Compare, TakesOcclusionAloneWhereBothHaveIt) {
  const std::string a = write("a.exr", {"occlusion", "depth.Z"}, {0.5f, 1, 0.5f, 1});
  const std::string b = write("b.exr", {"depth.Z", "occlusion"}, {9, 0.5f, 9, 0.5f});
  EXPECT_EQ(metrics(a, b)["rmse"], 0);
  EXPECT_EQ(metrics(a, b)["channels"], nlohmann::json({"occlusion"}));
}

TEST_F(Compare, PngsAreComparedByAllCommonChannels) {
  const std::string a = write("a.png", {"R", "G", "B"}, {0, 0, 0, 1, 1, 1});
  const std::string b = write("b.png", {"R", "G", "B"}, {0, 0, 1, 1, 1, 1});
  EXPECT_EQ(metrics(a, b)["values"], 6);
  EXPECT_DOUBLE_EQ(metrics(a, b)["mae"], 1 / 6.0);
}

TEST_F(Compare, WritesTheDifference) {
  const std::string a = write("a.exr", {"occlusion"}, {0, 0.5f, 0.5f, 1});
  const std::string b = write("b.exr", {"occlusion"}, {0, 0.25f, 0.75f, 1});
  expect_success({"compare", a, b, "--difference", path("d.exr")});
  const image::Image difference = image::read_image(path("d.exr"));
  EXPECT_EQ(difference.channels, std::vector<std::string>{"occlusion"});
  EXPECT_EQ(difference.pixels, (std::vector<float>{0, -0.25f, 0.25f, 0}));
  expect_success({"compare", a, b, "--difference", path("d.png"), "--gain", "4"});
  EXPECT_EQ(image::read_image(path("d.png")).pixels, (std::vector<float>{1, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 1}));
  // With --max-rmse too: the picture is wanted most where the limit is not kept.
  EXPECT_EQ(run_program({"compare", a, b, "--max-rmse", "0", "--difference", path("over.png")}).exit_code, 1);
  EXPECT_EQ(image::read_image(path("over.png")).width, 2);
}

TEST_F(Compare, RejectsImagesThatCannotBeCompared) {
  const std::string a = write("a.exr", {"occlusion"}, {0, 0, 0, 0});
  const std::string wide = write("wide.exr", {"occlusion"}, {0, 0, 0, 0}, 4);
  const std::string other = write("other.exr", {"depth.Z"}, {0, 0, 0, 0});
  expect_rejected({"compare", a, wide}, {"2x2", "4x1"});
  expect_rejected({"compare", a, other}, {"no channel in common"});
  expect_rejected({"compare", a, path("nowhere.exr")}, {"nowhere.exr"});
  expect_rejected({"compare", a, write_file("text.exr", "not an image")}, {"text.exr"});
  expect_rejected({"compare", a}, {"b is required"});
  expect_rejected({"compare", a, a, "--max-rmse", "-1"}, {"--max-rmse"});
  expect_rejected({"compare", a, a, "--max-rmse", "nan"}, {"--max-rmse"});
  expect_rejected({"compare", a, a, "--json", a}, {"is an input"});
  expect_rejected({"compare", a, a, "--difference", a}, {"is an input"});
  expect_rejected({"compare", a, a, "--difference", path("d.txt")}, {"d.txt"});
  expect_rejected({"compare", a, a, "--difference", path("d.png"), "--gain", "0"}, {"--gain"});
  expect_rejected({"compare", a, a, "--difference", path("d.exr"), "--gain", "2"}, {"--gain needs"});
}

}  // namespace
}  // namespace lkao::test
