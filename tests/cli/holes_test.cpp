// Holes by transparency: what lkao render, bake and info make of a glTF's alphaMode.
#include <algorithm>
#include <iterator>

#include <gmock/gmock.h>

#include "cli/program.h"
#include "image/image.h"
#include "scene/gltf_builder.h"

namespace lkao::test {
namespace {

using scene::GltfBuilder;
using testing::HasSubstr;

// 8 x 8 texels, every second of which is clear.
std::string checks_png() {
  image::Image image{8, 8, {"R", "G", "B", "A"}, {}};
  for (int i = 0; i < 64; ++i) {
    image.pixels.insert(image.pixels.end(), {0, 1, 0, (i + i / 8) % 2 == 0 ? 0.0f : 1.0f});
  }
  return image::encode_png("checks", image);
}

// Of one clear pixel and an opaque one, lossless.
std::string clear_and_opaque_webp() {
  const unsigned char bytes[] = {0x52, 0x49, 0x46, 0x46, 0x20, 0x00, 0x00, 0x00, 0x57, 0x45, 0x42, 0x50, 0x56, 0x50,
                                 0x38, 0x4c, 0x13, 0x00, 0x00, 0x00, 0x2f, 0x01, 0x00, 0x00, 0x10, 0x0f, 0x30, 0x32,
                                 0x83, 0x32, 0x3c, 0xf3, 0x1f, 0xf0, 0xa8, 0x40, 0x44, 0xff, 0x03, 0x00};
  return {std::begin(bytes), std::end(bytes)};
}

// A floor of 4 x 4 at y = 0, and a card of 2 x 2 over it that masks by an image; both with texture coordinates.
GltfBuilder card_over_floor(const std::string& image) {
  GltfBuilder parts = scene::gltf_leaf(image);
  parts.document["meshes"].push_back(parts.document["meshes"][0]);
  parts.primitive().erase("material");
  const nlohmann::json lying = {-0.70710678118654752, 0, 0, 0.70710678118654752};
  parts.document["nodes"] = {
      {{"name", "floor"}, {"mesh", 0}, {"rotation", lying}, {"scale", {4, 4, 4}}, {"translation", {-2, 0, 2}}},
      {{"name", "card"}, {"mesh", 1}, {"rotation", lying}, {"scale", {2, 2, 2}}, {"translation", {-1, 0.5, 1}}}};
  parts.document["scenes"][0]["nodes"] = {0, 1};
  return parts;
}

class HolesOfModels : public ProgramTest {
 protected:
  Arguments render(const std::string& model, const std::string& output, const Arguments& more = {}) const {
    Arguments arguments = {"render",    model, "-o",          path(output),     "--radius", "2", "--size", "48x32",
                           "--samples", "64",  "--eye=0,3,3", "--target=0,0,0", "--json",   "-", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  Arguments bake(const std::string& model, const std::string& output, const Arguments& more = {}) const {
    Arguments arguments = {"bake", model, "-o", path(output), "--radius", "2", "--samples", "64", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  nlohmann::json report(const Arguments& arguments) const {
    return nlohmann::json::parse(expect_success(arguments).out);
  }
};

TEST_F(HolesOfModels, AreLookedThroughAndBlockNothing) {
  GltfBuilder parts = card_over_floor(checks_png());
  const std::string model = write_file("card.glb", parts.glb());
  const nlohmann::json with_holes = report(render(model, "holes.exr", {"--reference"}));
  EXPECT_EQ(with_holes["reference"]["mismatched_rays"], 0);
  parts.document["materials"][0]["alphaMode"] = "OPAQUE";
  const std::string opaque = write_file("opaque.glb", parts.glb());
  expect_success(render(opaque, "whole.exr"));
  EXPECT_NE(read_file("holes.exr"), read_file("whole.exr"));
  // Of the floor behind the middle of the card something is seen.
  const image::Image image = image::read_image(path("holes.exr")), whole = image::read_image(path("whole.exr"));
  std::size_t darker_count = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    darker_count += image.pixels[i] > whole.pixels[i] + 0.2f ? 1 : 0;
  EXPECT_GT(darker_count, 20u);

  const ProgramResult taken_whole = run_program(render(model, "opaque.exr", {"--opaque"}));
  EXPECT_EQ(taken_whole.exit_code, 0);
  EXPECT_EQ(taken_whole.err, "lkao: " + model +
                                 ": material \"leaf\" has holes by transparency: its 2 triangles block "
                                 "as if whole\n");
  EXPECT_EQ(read_file("opaque.exr"), read_file("whole.exr"));
}

TEST_F(HolesOfModels, AreBakedOfAndPartsAreTheWhole) {
  const std::string model = write_file("card.glb", card_over_floor(checks_png()).glb());
  expect_success(bake(model, "whole.exr", {"--texture", "32", "--material", "no material"}));
  expect_success(bake(model, "holes.ply"));
  for (const char* const part : {"1/2", "2/2"}) expect_success(bake(model, "out.ply", {"--part", part}));
  expect_success({"merge", path("out.ply.1of2.part"), path("out.ply.2of2.part"), "--quiet"});
  EXPECT_EQ(read_file("out.ply"), read_file("holes.ply"));
  // Not of another image, nor where it means something else.
  GltfBuilder other = card_over_floor(checks_png());
  other.document["materials"][0]["alphaCutoff"] = 0.75;
  for (const GltfBuilder& changed : {card_over_floor(clear_and_opaque_webp()), other}) {
    write_file("card.glb", changed.glb());
    expect_rejected({"merge", path("out.ply.1of2.part"), path("out.ply.2of2.part"), "--quiet"},
                    {"the scene has changed"});
  }
  write_file("card.glb", card_over_floor(checks_png()).glb());
  // Half of the card is there: the middle of the floor gets about half of what the whole card hides.
  const ProgramResult whole =
      run_program(bake(model, "opaque.exr", {"--texture", "32", "--opaque", "--material", "no material"}));
  EXPECT_EQ(whole.exit_code, 0);
  const image::Image holes = image::read_image(path("whole.exr")), none = image::read_image(path("opaque.exr"));
  double sums[2] = {0, 0};
  for (std::size_t y = 12; y < 20; ++y) {
    for (std::size_t x = 12; x < 20; ++x) {
      const std::size_t i =
          (32 * y + x) * holes.channels.size() + static_cast<std::size_t>(holes.channel("visibility"));
      sums[0] += 1 - static_cast<double>(holes.pixels[i]);
      sums[1] += 1 - static_cast<double>(none.pixels[i]);
    }
  }
  EXPECT_GT(sums[1] / 64, 0.4);
  EXPECT_NEAR(sums[0] / sums[1], 0.5, 0.03);
}

TEST_F(HolesOfModels, BlendByAlphaAndSaySo) {
  GltfBuilder parts = card_over_floor(checks_png());
  parts.document["materials"][0]["alphaMode"] = "BLEND";
  const std::string model = write_file("card.glb", parts.glb());
  const ProgramResult result = run_program(render(model, "out.exr", {"--reference"}));
  EXPECT_EQ(result.err, "lkao: " + model +
                            ": material \"leaf\" is half-transparent: its 2 triangles block each ray "
                            "with the probability of their alpha\n");
  EXPECT_EQ(nlohmann::json::parse(result.out)["reference"]["mismatched_rays"], 0);
}

TEST_F(HolesOfModels, AreWholeWhereTheyCannotBe) {
  const std::string model = write_file("card.glb", card_over_floor(checks_png()).glb());
  const ProgramResult result = run_program(render(model, "out.exr", {"--lod", "k=3"}));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("\"leaf\" has holes by transparency: its 2 triangles block as if whole"));
  EXPECT_EQ(report({"info", model, "--json", "-"})["cut_out_triangles"], 2);
}

TEST_F(HolesOfModels, OfImagesThatAreBrokenAreOneLine) {
  const std::string model = write_file("card.glb", card_over_floor(checks_png().substr(0, 60)).glb());
  const ProgramResult result = run_program(render(model, "out.exr"));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, testing::StartsWith("lkao: " + model + ": cannot read 'images[0]': "));
  EXPECT_THAT(result.err, testing::EndsWith(": it counts as opaque, in material \"leaf\"\n"));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1);
}

TEST_F(HolesOfModels, AreNotOverwrittenByPictures) {
  GltfBuilder parts = card_over_floor(checks_png());
  const std::string image = write_file("checks.png", checks_png());
  parts.document["images"][0] = {{"uri", "checks.png"}};
  const std::string model = write_file("card.gltf", parts.gltf());
  expect_success(render(model, "out.png"));
  expect_rejected(render(model, "checks.png"), {"checks.png': it is an input"});
  expect_rejected(render("builtin:wall", "checks.png", {"--blockers", model}), {"checks.png': it is an input"});
}

TEST_F(HolesOfModels, OfWebPAreRead) {
  const std::string model = write_file("card.glb", card_over_floor(clear_and_opaque_webp()).glb());
  expect_success(render(model, "holes.exr"));
  EXPECT_EQ(report({"info", model, "--json", "-"})["cut_out_triangles"], 2);
}

}  // namespace
}  // namespace lkao::test
