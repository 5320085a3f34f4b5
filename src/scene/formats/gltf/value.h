// A value in a glTF's JSON together with its place, so that an error can say where the fault is.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace lkao::scene::gltf {

// Refers to the document, which must outlive it. All throw std::runtime_error where the value is not what is asked for:
// "accessors[3].count is \"many\", not a count".
class Value {
 public:
  // `place` as in "meshes[2].primitives[0]"; empty for the document itself.
  Value(const nlohmann::json& json, std::string place) : json_(&json), place_(std::move(place)) {}

  const std::string& place() const { return place_; }

  // A member of an object; `at` throws where it is missing.
  std::optional<Value> find(const char* key) const;
  Value at(const char* key) const;
  std::vector<std::string> keys() const;
  // What an extension says of this object.
  std::optional<Value> extension(const char* name) const;

  // A list.
  std::size_t size() const;
  Value element(std::size_t index) const;

  double number() const;
  void numbers(std::span<double> numbers) const;  // exactly as many
  std::size_t count() const;                      // an integer from 0 to 2^53
  bool boolean() const;
  const std::string& text() const;

 private:
  // What an error says of it: where it is, and what.
  std::string subject() const;
  std::string excerpt() const;

  const nlohmann::json* json_;
  std::string place_;
};

// A member's count, or `otherwise` where there is none.
std::size_t count_or(const Value& object, const char* key, std::size_t otherwise);

// How many entries the document's list `name` has; none where it is missing.
std::size_t size_of_list(const Value& root, const char* name);

// The entry of the document's list `name` that `index` names.
Value item_of_list(const Value& root, const char* name, const Value& index);

}  // namespace lkao::scene::gltf
