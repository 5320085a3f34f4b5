#include "cli/normals_option.h"

#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "cli/parsed_option.h"

namespace lkao::cli {

using scene::NormalSource;

void add_normals_option(CLI::App& app, std::optional<NormalSource>& source) {
  const auto parse = [](const std::string& text) { return method::parse_word(kNormalSourceWords, text); };
  add_parsed(app, "--normals", source, parse,
             "Normals of receivers: file, those that the scene's file has; smooth, averaged around each position; "
             "facet, each triangle's own (default: file where it has any, otherwise facet). No ray goes below the "
             "triangle's own horizon")
      ->type_name(method::join(method::list_words(kNormalSourceWords), "|"));
}

NormalSource choose_normals(const std::optional<NormalSource>& source, const SceneInput& scene) {
  if (source == NormalSource::file && scene.mesh.normals.empty()) {
    throw std::invalid_argument(
        fmt::format("--normals file: {} has no normals; smooth and facet need none", scene.name));
  }
  return source ? *source : scene::usual_normals(scene.mesh);
}

}  // namespace lkao::cli
