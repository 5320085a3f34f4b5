#include "bench/radii.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

namespace lkao::bench {

void add_radii_option(CLI::App& app, const std::string& name, std::vector<method::Radius>& radii,
                      const std::string& help) {
  const auto store = [&radii, name](const std::vector<std::string>& texts) {
    radii.clear();
    for (const std::string& text : texts) {
      try {
        radii.push_back(method::parse_radius(text));
      } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(fmt::format("{}: {}", name, error.what()));
      }
      const method::Radius& radius = radii.back();
      if (radius.is_percentage || std::isinf(radius.value) || radius.value <= double{kMaxStudyRadius}) continue;
      throw std::invalid_argument(
          fmt::format("{}: expected at most {:g}, or inf, got '{}'", name, kMaxStudyRadius, text));
    }
  };
  app.add_option_function<std::vector<std::string>>(name, store, help)->delimiter(',');
}

std::vector<float> lengths_of(const std::vector<method::Radius>& radii, const StudyScene& scene) {
  const Bounds bounds = scene::bounds_of(scene.mesh);
  std::vector<float> lengths;
  for (const method::Radius& radius : radii) lengths.push_back(static_cast<float>(radius.in(bounds)));
  return lengths;
}

}  // namespace lkao::bench
