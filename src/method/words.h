// The words of an enum: one table says them all, and everything else is made of it.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

namespace lkao::method {

// A table is an array of these, one for each value: `inline constexpr Word<Device> kDeviceWords[] = {...}`.
template <class Value>
struct Word {
  std::string_view word;
  Value value;
};

template <class Value, std::size_t kCount>
std::vector<std::string> list_words(const Word<Value> (&words)[kCount]) {
  std::vector<std::string> list;
  for (const Word<Value>& entry : words) list.emplace_back(entry.word);
  return list;
}

// For help and errors: "one or two".
inline std::string join(const std::vector<std::string>& words, std::string_view separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : std::string(separator)) + word;
  return text;
}

[[noreturn]] inline void reject_word(const std::vector<std::string>& known, std::string_view text) {
  throw std::invalid_argument(fmt::format("expected {}, got '{}'", join(known, " or "), text));
}

// Throws std::invalid_argument saying what was expected and what it got.
template <class Value, std::size_t kCount>
Value parse_word(const Word<Value> (&words)[kCount], std::string_view text) {
  for (const Word<Value>& entry : words) {
    if (entry.word == text) return entry.value;
  }
  reject_word(list_words(words), text);
}

// Of a value that is in the table; "" otherwise.
template <class Value, std::size_t kCount>
constexpr std::string_view word_of(const Word<Value> (&words)[kCount], std::type_identity_t<Value> value) {
  for (const Word<Value>& entry : words) {
    if (entry.value == value) return entry.word;
  }
  return "";
}

}  // namespace lkao::method
