#include "cli/texture_options.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "cli/parsed_option.h"
#include "method/words.h"

namespace lkao::cli {
namespace {

using bake::BentNormals, scene::TextureWrap;

constexpr method::Word<TextureWrap> kWrapWords[] = {
    {"repeat", TextureWrap::repeat}, {"mirror", TextureWrap::mirror}, {"clamp", TextureWrap::clamp}};
constexpr method::Word<BentNormals> kSpaceWords[] = {{"object", BentNormals::object},
                                                     {"tangent", BentNormals::tangent}};

constexpr int kMostUvSets = 64;

// "1024", or "2048x1024".
Size parse_texture_size(const std::string& text) {
  const Size size = parse_size(text.find('x') == text.npos ? text + "x" + text : text);
  if (size.width > bake::kMaxTextureSize || size.height > bake::kMaxTextureSize) {
    throw std::invalid_argument(fmt::format("at most {} texels a side, got '{}'", bake::kMaxTextureSize, text));
  }
  return size;
}

method::Radius parse_extrusion(const std::string& text) {
  const method::Radius extrusion = method::parse_radius(text);
  if (std::isinf(extrusion.value)) throw std::invalid_argument("expected a length or a percentage, got 'inf'");
  return extrusion;
}

template <class Value, std::size_t kCount>
std::string type_of(const method::Word<Value> (&words)[kCount]) {
  return method::join(method::list_words(words), "|");
}

auto integer_in(int least, int most) {
  return [least, most](const std::string& text) { return parse_integer(text, least, most); };
}

void add_mapping_options(CLI::App& app, CLI::Option* texture, TextureSettings& settings) {
  add_parsed(app, "--uv", settings.uv_set, integer_in(0, kMostUvSets - 1),
             "Which texture coordinates of the file to use (default: 0)")
      ->type_name("N")
      ->needs(texture);
  app.add_option("--material", settings.material, "Only what has the material of this name")
      ->type_name("NAME")
      ->needs(texture);
  app.add_flag("--shared-map", settings.is_shared, "One map for all materials, not one for each")->needs(texture);
  add_parsed(
      app, "--wrap", settings.wrap, [](const std::string& text) { return method::parse_word(kWrapWords, text); },
      "What lies outside of [0, 1] (default: what the file says, or repeat)")
      ->type_name(type_of(kWrapWords))
      ->needs(texture);
  app.add_flag("--udim", settings.udim, "A map for each unit square of texture coordinates: NAME.1001.png, ...")
      ->needs(texture);
}

void add_map_options(CLI::App& app, CLI::Option* texture, TextureSettings& settings) {
  add_parsed(app, "--grid", settings.grid, integer_in(1, bake::kMaxTextureGrid),
             "Samples along each side of a texel, which cast --samples rays each (default: 1)")
      ->type_name("N")
      ->needs(texture);
  add_parsed(app, "--margin", settings.margin, integer_in(0, bake::kMaxTextureSize),
             "Texels by which charts grow beyond their borders (default: enough for mip maps of 64 texels)")
      ->type_name("TEXELS")
      ->needs(texture);
  add_parsed(
      app, "--bent-normals", settings.bent_normals,
      [](const std::string& text) { return method::parse_word(kSpaceWords, text); },
      "Whence light comes, in object or tangent space: channels of an .exr, or NAME.bent.png beside a .png")
      ->type_name(type_of(kSpaceWords))
      ->needs(texture);
  app.add_flag("--thickness", settings.thickness,
               "Cast rays into the body: what is open then is how thick it is, with --falloff linear as a share of the "
               "radius")
      ->needs(texture);
  CLI::Option* const detailed =
      app.add_option(
             "--detailed", settings.detailed,
             "A mesh file in the scene's coordinates whose occlusion the map shows: the scene is its simple form, "
             "and each of its points stands for the nearest of the detailed surface along the smooth normal")
          ->type_name("FILE")
          ->needs(texture);
  for (const char* name : {"--ground", "--blockers", "--flip", "--own-object"})
    detailed->excludes(app.get_option(name));
  add_parsed(app, "--extrusion", settings.extrusion, parse_extrusion,
             "How far the detailed surface may be from the scene's, inside or outside: a length, or a share of the "
             "diagonal of the scene's box (default: 2%)")
      ->type_name("LENGTH|P%")
      ->needs(detailed);
  app.add_flag("--keep-seams", settings.keeps_seams, "Do not level both sides of the texture's seams")->needs(texture);
  add_parsed(app, "--strength", settings.strength, parse_non_negative_number,
             "Write STRENGTH x occlusion ^ CONTRAST: for taste; changes the data (default: 1)")
      ->type_name("STRENGTH")
      ->needs(texture);
  add_parsed(app, "--contrast", settings.contrast, parse_positive_number, "See --strength (default: 1)")
      ->type_name("CONTRAST")
      ->needs(texture);
}

}  // namespace

bake::TextureOptions TextureSettings::options(std::optional<std::uint32_t> chosen_material,
                                              const scene::TextureWraps& wraps, const bake::Cage* cage) const {
  return {.width = size->width,
          .height = size->height,
          .wrap_u = wrap.value_or(wraps.u),
          .wrap_v = wrap.value_or(wraps.v),
          .udim = udim,
          .material = chosen_material,
          .grid = grid,
          .bent_normals = bent_normals,
          .cage = cage,
          .inwards = thickness,
          .level_seams = !keeps_seams,
          .margin = margin};
}

void add_texture_options(CLI::App& app, TextureSettings& settings) {
  CLI::Option* const texture =
      add_parsed(app, "--texture", settings.size, parse_texture_size,
                 "Bake into textures of so many texels: -o is an image, or a glTF that gets them")
          ->type_name("N|WxH");
  for (const char* name : {"--per", "--filter", "--quality", "--linear", "--attribute"})
    texture->excludes(app.get_option(name));
  add_mapping_options(app, texture, settings);
  add_map_options(app, texture, settings);
}

}  // namespace lkao::cli
