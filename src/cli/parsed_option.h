// Options whose values are made of their text by functions of this program.
#pragma once

#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>

namespace lkao::cli {

// Adds an option whose text `parse` turns into `value`. What `parse` throws becomes an error that names the option.
template <class Value, class Parse>
CLI::Option* add_parsed(CLI::App& app, const std::string& name, Value& value, Parse parse,
                        const std::string& description) {
  const auto store = [&value, parse, name](const std::string& text) {
    try {
      value = parse(text);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(name + ": " + error.what());
    }
  };
  return app.add_option_function<std::string>(name, store, description);
}

}  // namespace lkao::cli
