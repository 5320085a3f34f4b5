// Options whose values are words of enums.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "method/words.h"

namespace lkao::bench {

// Several of them, with commas between; the default is what `values` holds.
template <class Value, std::size_t kCount>
CLI::Option* add_words_option(CLI::App& app, const std::string& name, std::vector<Value>& values,
                              const method::Word<Value> (&words)[kCount], const std::string& help = "") {
  std::vector<std::pair<std::string, Value>> known;
  for (const method::Word<Value>& entry : words) known.emplace_back(entry.word, entry.value);
  std::vector<std::string> defaults;
  for (const Value value : values) defaults.emplace_back(method::word_of(words, value));
  return app.add_option(name, values, help)
      ->delimiter(',')
      ->transform(CLI::CheckedTransformer(known))
      ->default_str(method::join(defaults, ","));
}

}  // namespace lkao::bench
