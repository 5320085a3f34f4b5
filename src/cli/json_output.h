// Results for other programs, as JSON.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "cli/output_files.h"

namespace lkao::cli {

// Keeps the keys in the order in which they were written.
using Json = nlohmann::ordered_json;

// Where `--json` goes: a file among the run's outputs, stdout, or nowhere.
class JsonOutput {
 public:
  // `path` is a file to claim from `outputs`, "-" for stdout or empty for none.
  JsonOutput(const std::string& path, OutputFiles& outputs);

  // Ends the run: writes the document, gives all files of `outputs` their names, and only then prints to stdout.
  // JSON knows neither infinity nor NaN: such a number becomes null. Throws std::runtime_error where writing fails.
  void write_and_commit(const Json& document) const;

 private:
  std::string path_;
  std::string temporary_path_;
  OutputFiles& outputs_;
};

}  // namespace lkao::cli
