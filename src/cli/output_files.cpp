#include "cli/output_files.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "cli/interrupt.h"
#include "image/image.h"

namespace lkao::cli {
namespace fs = std::filesystem;

const std::string& OutputFiles::claim(const std::string& path) {
  std::error_code ignored;  // what cannot be looked at is left to AtomicFile to reject
  const fs::path place = fs::weakly_canonical(path, ignored);
  if (std::find(claimed_.begin(), claimed_.end(), place) != claimed_.end()) {
    throw std::runtime_error(fmt::format("cannot write '{}': it is named for two outputs", path));
  }
  const auto is_same_file = [&](const std::string& input) { return fs::equivalent(path, input, ignored); };
  if (std::any_of(inputs_.begin(), inputs_.end(), is_same_file)) {
    throw std::runtime_error(fmt::format("cannot write '{}': it is an input", path));
  }
  files_.push_back(std::make_unique<image::AtomicFile>(path));
  claimed_.push_back(place);
  return files_.back()->temporary_path();
}

const std::string& OutputFiles::claim_image(const std::string& path) {
  image::check_image_path(path);
  return claim(path);
}

void OutputFiles::commit() {
  const InterruptHold hold;
  for (const auto& file : files_) file->commit();
}

std::string ending_of(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return ending;
}

}  // namespace lkao::cli
