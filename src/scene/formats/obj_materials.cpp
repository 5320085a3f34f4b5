#include "scene/formats/obj_materials.h"

#include <algorithm>
#include <stdexcept>

#include "scene/formats/obj_words.h"
#include "scene/formats/text.h"

namespace lkao::scene {

namespace {

// The opacity that "d" or, turned round, "Tr" gives; one where there is no number.
double take_opacity(ObjWords& words, bool is_turned) {
  if (words.has_word()) {
    try {
      std::string_view word = words.take_word();
      if (word == "-halo") word = words.take_word();
      const double opacity = is_turned ? 1 - parse_number(word) : parse_number(word);
      return opacity >= 0 && opacity <= 1 ? opacity : 1;
    } catch (const std::runtime_error&) {
    }
  }
  return 1;
}

// How many words belong to an option of a map, at most; those of vectors may be fewer.
int most_words_of(std::string_view option) {
  if (option == "-o" || option == "-s" || option == "-t") return 3;
  return option == "-mm" ? 2 : 1;
}

// The number `i` of a vector.
void take_number_of(glm::dvec2& vector, int i, std::string_view word) {
  if (i < 2 && is_number(word)) vector[i] = parse_number(word);
}

// Whether the word `i` behind an option leaves the image as it is.
bool is_harmless(std::string_view option, int i, std::string_view word) {
  if (option == "-mm") return is_number(word) && parse_number(word) == i;
  if (option == "-t") return is_number(word) && parse_number(word) == 0;
  return option != "-imfchan" || word == "m";
}

void take_value(std::string_view option, int i, std::string_view word, ObjOpacityMap& map) {
  if (option == "-clamp") map.clamps = word == "on";
  if (option == "-s") take_number_of(map.scale, i, word);
  if (option == "-o") take_number_of(map.offset, i, word);
  const bool is_known = std::find(map.ignored.begin(), map.ignored.end(), option) != map.ignored.end();
  if (!is_known && !is_harmless(option, i, word)) map.ignored.emplace_back(option);
}

// Options come first, and the name is what is left: it may have blanks.
ObjOpacityMap take_map(ObjWords& words) {
  ObjOpacityMap map;
  std::string_view rest = words.take_rest();
  while (rest.starts_with('-')) {
    ObjWords option(rest);
    const std::string_view name = option.take_word();
    std::string_view behind = option.take_rest();
    for (int i = 0; i < most_words_of(name); ++i) {
      ObjWords value(behind);
      const std::string_view word = value.take_word();
      if (i > 0 && !is_number(word)) break;
      take_value(name, i, word, map);
      behind = value.take_rest();
    }
    rest = behind;
  }
  map.name = rest;
  return map;
}

}  // namespace

std::vector<ObjMaterial> see_through_materials(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  std::vector<ObjMaterial> materials;
  for (ObjWords words(text); !words.is_at_end(); words.skip_line()) {
    const std::string_view keyword = words.take_word();
    if (keyword == "newmtl") {
      materials.push_back({std::string(words.take_rest())});
    } else if (materials.empty()) {
      continue;
    } else if (keyword == "map_d" || keyword == "map_D" || keyword == "map_Tr") {
      materials.back().map = take_map(words);
    } else if (keyword == "d") {
      materials.back().opacity = take_opacity(words, false);
    } else if (keyword == "Tr") {
      // Programs do not agree whether "Tr 1" is opaque.
      const double opacity = take_opacity(words, true);
      if (opacity > 0 && opacity < 1) materials.back().opacity = opacity;
    }
  }
  std::erase_if(materials, [](const ObjMaterial& material) {
    return material.name.empty() || (material.opacity == 1 && material.map.name.empty());
  });
  return materials;
}

}  // namespace lkao::scene
