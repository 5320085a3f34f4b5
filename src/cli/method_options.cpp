#include "cli/method_options.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "cli/parsed_option.h"
#include "method/setting_options.h"

namespace lkao::cli {
namespace {

using method::MethodKind, method::Setting, method::Settings;
using Ability = bool method::Abilities::*;

std::vector<const MethodKind*> built_kinds() {
  std::vector<const MethodKind*> kinds;
  for (const MethodKind& kind : method::method_kinds()) {
    if (kind.is_built()) kinds.push_back(&kind);
  }
  return kinds;
}

std::string method_help() {
  std::string text = "What answers:";
  for (const MethodKind* kind : built_kinds()) text += fmt::format(" {}, {};", kind->word, kind->summary);
  text.back() = ' ';
  return text + fmt::format("(default: {})", method::traversal().word);
}

// "--kernel simd and scalar": of the settings that were given, the words with which the method can do it.
std::vector<std::string> able_words(const MethodOptions& options, const Setting& setting, Ability ability) {
  std::vector<std::string> words;
  const auto* const all = std::get_if<std::vector<std::string>>(&setting.values);
  if (all == nullptr) return words;
  for (const std::string& word : *all) {
    Settings other = options.settings;
    other.set(setting, word);
    if (options.kind->abilities(other).*ability) words.push_back(word);
  }
  return words;
}

[[noreturn]] void refuse(std::string_view option, std::string_view name, const std::vector<std::string>& able,
                         std::string_view word) {
  throw std::invalid_argument(
      fmt::format("{} is for --{} {}, not for --{} {}", option, name, method::join(able, " and "), name, word));
}

}  // namespace

void add_method_options(CLI::App& app, MethodOptions& options) {
  const auto parse_method = [](const std::string& word) { return &method::method_named(word); };
  add_parsed(app, "--method", options.kind, parse_method, method_help())
      ->type_name(method::join(method::method_words(), "|"));
  method::add_setting_options(app, options.settings, built_kinds());
}

void check_method(const MethodOptions& options) {
  const MethodKind& kind = *options.kind;
  if (!kind.is_built()) {
    throw std::runtime_error(
        fmt::format("--method {}: this program was built without OpenGL (LKAO_BUILD_GL)", kind.word));
  }
  std::string own_names;
  for (const Setting* setting : kind.settings) {
    own_names += (own_names.empty() ? ", which has --" : ", --") + setting->name;
  }
  for (const Setting* setting : options.settings.chosen()) {
    const std::vector<std::string> words = method::words_of_methods_with(*setting);
    if (std::find(words.begin(), words.end(), kind.word) != words.end()) continue;
    throw std::invalid_argument(fmt::format("--{} is for --method {}, not for --method {}{}", setting->name,
                                            method::join(words, " and "), kind.word, own_names));
  }
}

void require_ability(const MethodOptions& options, Ability ability, std::string_view option) {
  const MethodKind& kind = *options.kind;
  if (kind.abilities(options.settings).*ability) return;
  for (const Setting* setting : options.settings.chosen()) {
    const std::vector<std::string> able = able_words(options, *setting, ability);
    if (!able.empty()) refuse(option, setting->name, able, options.settings.text(*setting));
  }
  std::vector<std::string> able;
  for (const MethodKind* other : built_kinds()) {
    if (other->abilities({}).*ability) able.emplace_back(other->word);
  }
  refuse(option, "method", able, kind.word);
}

void check_question(const MethodOptions& options, const OcclusionOptions& occlusion) {
  using method::Abilities;
  const std::string_view falloff = occlusion.falloff.name();
  require_ability(options,
                  falloff == "constant" ? &Abilities::constant_falloff
                  : falloff == "linear" ? &Abilities::linear_falloff
                                        : &Abilities::other_falloffs,
                  fmt::format("--falloff {}", falloff));
  if (occlusion.weighting == Weighting::uniform) {
    require_ability(options, &Abilities::uniform_weighting, "--weighting uniform");
  }
  if (occlusion.sidedness == Sidedness::one_sided) require_ability(options, &Abilities::one_sided, "--sided one");
  if (occlusion.min_distance > 0) require_ability(options, &Abilities::min_distance, "--min-distance");
  if (occlusion.radius && std::isinf(occlusion.radius->value)) {
    require_ability(options, &Abilities::infinite_radius, "--radius inf");
  }
  if (!occlusion.radius || !occlusion.question(occlusion.radius->value).has_infinite_lengths()) return;
  require_ability(options, &method::Abilities::infinite_lengths,
                  fmt::format("--radius inf with --falloff {}", occlusion.falloff.name()));
}

}  // namespace lkao::cli
