#include "method/settings.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "method/read_number.h"

namespace lkao::method {

void Setting::check(const std::string& text) const {
  if (const auto* const words = std::get_if<std::vector<std::string>>(&values)) {
    if (std::find(words->begin(), words->end(), text) == words->end()) reject_word(*words, text);
    return;
  }
  const Range& range = std::get<Range>(values);
  const std::optional<double> number = read_number<double>(text);
  const bool is_in_range = number && *number >= range.least && *number <= range.most;
  if (is_in_range && (!range.is_whole || *number == std::floor(*number))) return;
  throw std::invalid_argument(fmt::format("expected a {}number from {} to {}, got '{}'", range.is_whole ? "whole " : "",
                                          range.least, range.most, text));
}

std::string Setting::values_text() const {
  if (const auto* const words = std::get_if<std::vector<std::string>>(&values)) return join(*words, "|");
  const Range& range = std::get<Range>(values);
  return fmt::format("{}..{}", range.least, range.most);
}

Setting flag_setting(std::string name, std::string help) {
  return {std::move(name), std::move(help), std::vector<std::string>{"off", "on"}, "off", true};
}

void Settings::set(const Setting& setting, const std::string& text) {
  setting.check(text);
  chosen_[&setting] = text;
}

std::vector<const Setting*> Settings::chosen() const {
  std::vector<const Setting*> settings;
  for (const auto& [setting, text] : chosen_) settings.push_back(setting);
  return settings;
}

const std::string& Settings::text(const Setting& setting) const {
  const auto found = chosen_.find(&setting);
  return found == chosen_.end() ? setting.default_text : found->second;
}

bool Settings::flag(const Setting& setting) const { return text(setting) == "on"; }

double Settings::number(const Setting& setting) const { return read_number<double>(text(setting)).value(); }

}  // namespace lkao::method
