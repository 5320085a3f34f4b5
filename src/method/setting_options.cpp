#include "method/setting_options.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

namespace lkao::method {
namespace {

std::vector<const Setting*> all_settings(const std::vector<const MethodKind*>& kinds) {
  std::vector<const Setting*> all;
  for (const MethodKind* kind : kinds) {
    for (const Setting* setting : kind->settings) {
      if (std::find(all.begin(), all.end(), setting) == all.end()) all.push_back(setting);
    }
  }
  return all;
}

}  // namespace

CLI::Option* add_setting_option(CLI::App& app, Settings& settings, const Setting& setting) {
  const auto store = [&settings, &setting](const std::string& text) {
    try {
      settings.set(setting, text);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("--{}: {}", setting.name, error.what()));
    }
  };
  if (setting.is_flag) {
    return app.add_flag_callback(
        "--" + setting.name, [store] { store("on"); }, setting.help);
  }
  const std::string help = fmt::format("{} (default: {})", setting.help, setting.default_text);
  return app.add_option_function<std::string>("--" + setting.name, store, help)->type_name(setting.values_text());
}

void add_setting_options(CLI::App& app, Settings& settings, const std::vector<const MethodKind*>& kinds) {
  for (const Setting* setting : all_settings(kinds)) {
    add_setting_option(app, settings, *setting)
        ->group(fmt::format("Settings of {}", join(words_of_methods_with(*setting), " and ")));
  }
}

}  // namespace lkao::method
