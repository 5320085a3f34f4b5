#include "scene/formats/gltf/value.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "scene/formats/text.h"

namespace lkao::scene::gltf {

using nlohmann::json;

std::optional<Value> Value::find(const char* key) const {
  if (!json_->is_object()) throw std::runtime_error(fmt::format("{} is {}, not an object", subject(), excerpt()));
  const auto member = json_->find(key);
  if (member == json_->end()) return std::nullopt;
  return Value(*member, place_.empty() ? key : place_ + "." + key);
}

Value Value::at(const char* key) const {
  if (std::optional<Value> member = find(key)) return *std::move(member);
  throw std::runtime_error(fmt::format("{} has no {}", subject(), in_quotes(key)));
}

std::vector<std::string> Value::keys() const {
  std::vector<std::string> keys;
  if (!json_->is_object()) return keys;
  for (const auto& member : json_->items()) keys.push_back(member.key());
  return keys;
}

std::optional<Value> Value::extension(const char* name) const {
  const std::optional<Value> extensions = find("extensions");
  return extensions ? extensions->find(name) : std::nullopt;
}

std::size_t Value::size() const {
  if (!json_->is_array()) throw std::runtime_error(fmt::format("{} is {}, not a list", place_, excerpt()));
  return json_->size();
}

Value Value::element(std::size_t index) const { return {(*json_)[index], fmt::format("{}[{}]", place_, index)}; }

double Value::number() const {
  if (!json_->is_number()) throw std::runtime_error(fmt::format("{} is {}, not a number", place_, excerpt()));
  return json_->get<double>();
}

void Value::numbers(std::span<double> numbers) const {
  if (size() != numbers.size()) {
    throw std::runtime_error(fmt::format("{} has {} numbers, not {}", place_, size(), numbers.size()));
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = element(i).number();
}

std::size_t Value::count() const {
  constexpr double kLargest = 9007199254740992.0;  // up to which a double holds every integer
  const double value = json_->is_number() ? json_->get<double>() : -1;
  if (!(value >= 0 && value <= kLargest && value == std::floor(value))) {
    throw std::runtime_error(fmt::format("{} is {}, not a count", place_, excerpt()));
  }
  return static_cast<std::size_t>(value);
}

bool Value::boolean() const {
  if (!json_->is_boolean()) throw std::runtime_error(fmt::format("{} is {}, not true or false", place_, excerpt()));
  return json_->get<bool>();
}

const std::string& Value::text() const {
  if (!json_->is_string()) throw std::runtime_error(fmt::format("{} is {}, not a text", place_, excerpt()));
  return json_->get_ref<const std::string&>();
}

std::string Value::subject() const { return place_.empty() ? "the document" : place_; }

// Not json::dump, which recurses.
std::string Value::excerpt() const {
  if (json_->is_string()) return in_quotes(json_->get_ref<const std::string&>());
  if (json_->is_number()) return fmt::format("{}", json_->get<double>());
  if (json_->is_boolean()) return json_->get<bool>() ? "true" : "false";
  return json_->is_object() ? "an object" : json_->is_array() ? "a list" : "null";
}

std::size_t count_or(const Value& object, const char* key, std::size_t otherwise) {
  const std::optional<Value> member = object.find(key);
  return member ? member->count() : otherwise;
}

std::size_t size_of_list(const Value& root, const char* name) {
  const std::optional<Value> list = root.find(name);
  return list ? list->size() : 0;
}

Value item_of_list(const Value& root, const char* name, const Value& index) {
  const std::size_t number = index.count();
  if (number >= size_of_list(root, name)) {
    throw std::runtime_error(fmt::format("{} names {}[{}], which does not exist", index.place(), name, number));
  }
  return root.at(name).element(number);
}

}  // namespace lkao::scene::gltf
