#include "cli/json_output.h"

#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

namespace lkao::cli {
namespace {

void write_text(const std::string& path, const std::string& temporary_path, const std::string& text) {
  std::ofstream file(temporary_path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(fmt::format("cannot write '{}'", path));
}

}  // namespace

JsonOutput::JsonOutput(const std::string& path, OutputFiles& outputs) : path_(path), outputs_(outputs) {
  if (!path.empty() && path != "-") temporary_path_ = outputs.claim(path);
}

void JsonOutput::write_and_commit(const Json& document) const {
  // Names of files need not be UTF-8: bad bytes are replaced.
  const std::string text = document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  if (!temporary_path_.empty()) write_text(path_, temporary_path_, text);
  outputs_.commit();
  if (path_ == "-") fmt::print("{}", text);
}

}  // namespace lkao::cli
