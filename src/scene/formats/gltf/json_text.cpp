#include "scene/formats/gltf/json_text.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "scene/formats/text.h"

namespace lkao::scene::gltf {

namespace {

std::size_t skip_spaces(std::string_view text, std::size_t at) {
  while (at < text.size() && is_blank(text[at])) ++at;
  return at;
}

// Behind the string that begins with the quotation mark there.
std::size_t skip_string(std::string_view text, std::size_t at) {
  for (++at; at < text.size() && text[at] != '"'; ++at) at += text[at] == '\\' ? 1 : 0;
  return std::min(at + 1, text.size());
}

// Behind the value that begins there.
std::size_t skip_value(std::string_view text, std::size_t at) {
  std::size_t depth = 0;
  while (at < text.size()) {
    const char c = text[at];
    if (c == '"') {
      at = skip_string(text, at);
    } else if (c == '{' || c == '[') {
      ++depth;
      ++at;
      continue;
    } else if (c == '}' || c == ']') {
      --depth;
      ++at;
    } else if (depth == 0) {
      const std::size_t end = text.find_first_of(",]} \t\n\r", at);
      return std::min(end, text.size());
    } else {
      ++at;
      continue;
    }
    if (depth == 0) return at;
  }
  return at;
}

std::string unescaped(std::string_view key) {
  if (key.find('\\') == key.npos) return std::string(key);
  return nlohmann::json::parse('"' + std::string(key) + '"').get<std::string>();
}

}  // namespace

// Parsers pass over a byte order mark.
JsonText::JsonText(std::string text)
    : text_(std::move(text)), root_(skip_spaces(text_, text_.starts_with("\xef\xbb\xbf") ? 3 : 0)) {}

const std::vector<JsonText::Child>& JsonText::children(Place container) const {
  const auto [entry, is_new] = children_.try_emplace(container);
  std::vector<Child>& children = entry->second;
  if (!is_new) return children;
  const std::string_view text(text_);
  const bool is_object = text[container] == '{';
  std::size_t at = skip_spaces(text, container + 1);
  while (at < text.size() && text[at] != '}' && text[at] != ']') {
    std::string_view key;
    if (is_object) {
      const std::size_t end = skip_string(text, at);
      key = text.substr(at + 1, end - at - 2);
      at = skip_spaces(text, skip_spaces(text, end) + 1);  // behind the colon
    }
    const std::size_t end = skip_value(text, at);
    children.push_back({key, at, end});
    at = skip_spaces(text, end);
    if (at < text.size() && text[at] == ',') at = skip_spaces(text, at + 1);
  }
  return children;
}

std::optional<JsonText::Place> JsonText::find(Place object, std::string_view key) const {
  const std::vector<Child>& members = children(object);
  const auto is_it = [&](const Child& member) { return unescaped(member.key) == key; };
  const auto last = std::find_if(members.rbegin(), members.rend(), is_it);
  return last == members.rend() ? std::nullopt : std::optional(last->value);
}

std::vector<std::string> JsonText::members_but(Place object, const std::set<std::string>& left_out) const {
  std::vector<std::string> members;
  members.reserve(children(object).size());
  for (const Child& member : children(object)) {
    if (left_out.contains(unescaped(member.key))) continue;
    members.push_back(fmt::format("\"{}\":{}", member.key, text_of(member.value)));
  }
  return members;
}

std::string_view JsonText::text_of(Place value) const {
  return std::string_view(text_).substr(value, skip_value(text_, value) - value);
}

void JsonText::set(Place object, std::string_view key, const std::string& value) {
  if (const std::optional<Place> member = find(object, key)) {
    replacements_[*member] = value;
  } else {
    insert(object, to_json_string(key) + ':' + value);
  }
}

void JsonText::append(Place list, const std::string& value) { insert(list, value); }

void JsonText::insert(Place container, const std::string& value) {
  std::string& insertion = insertions_[container];
  if (!insertion.empty() || !children(container).empty()) insertion += ',';
  insertion += value;
}

std::string JsonText::changed() const {
  // By where they begin in the text: what is put there, and how many bytes it stands for.
  struct Change {
    std::size_t at;
    std::size_t replaced_size;
    const std::string* text;
  };
  std::vector<Change> changes;
  changes.reserve(replacements_.size() + insertions_.size());
  for (const auto& [place, text] : replacements_) changes.push_back({place, text_of(place).size(), &text});
  for (const auto& [container, text] : insertions_) {
    const std::vector<Child>& others = children(container);
    changes.push_back({others.empty() ? container + 1 : others.back().end, 0, &text});
  }
  // What comes behind a changed last value begins where that ends.
  std::stable_sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) { return a.at < b.at; });
  std::string result;
  std::size_t done = 0;
  for (const Change& change : changes) {
    result.append(text_, done, change.at - done).append(*change.text);
    done = change.at + change.replaced_size;
  }
  return result.append(text_, done);
}

std::string joined(const std::vector<std::string>& parts, char open, char close) {
  return fmt::format("{}{}{}", open, fmt::join(parts, ","), close);
}

std::string to_json_string(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace lkao::scene::gltf
