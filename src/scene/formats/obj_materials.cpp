#include "scene/formats/obj_materials.h"

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
      return is_turned ? 1 - parse_number(word) : parse_number(word);
    } catch (const std::runtime_error&) {
    }
  }
  return 1;
}

}  // namespace

std::vector<std::string> see_through_materials(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  std::vector<std::string> names;
  std::string_view material;
  const auto add = [&] {
    if (!material.empty() && (names.empty() || names.back() != material)) names.emplace_back(material);
  };
  for (ObjWords words(text); !words.is_at_end(); words.skip_line()) {
    const std::string_view keyword = words.take_word();
    if (keyword == "newmtl") {
      material = words.take_rest();
    } else if (keyword == "map_d" || keyword == "map_D" || keyword == "map_Tr") {
      if (words.has_word()) add();
    } else if (keyword == "d") {
      if (take_opacity(words, false) < 1) add();
    } else if (keyword == "Tr") {
      // Programs do not agree whether "Tr 1" is opaque.
      const double opacity = take_opacity(words, true);
      if (opacity > 0 && opacity < 1) add();
    }
  }
  return names;
}

}  // namespace lkao::scene
