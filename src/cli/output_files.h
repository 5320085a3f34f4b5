// The files of one run: claimed before the work, given their names together after it.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "image/atomic_file.h"

namespace lkao::cli {

// Claims places for output files at once, so that a place that cannot be written to is found before the long
// computation. Until commit() the files are temporary ones; they vanish where the run fails or is interrupted.
class OutputFiles {
 public:
  // `inputs` are what the run reads; no output may overwrite one. Names that are no files do no harm.
  explicit OutputFiles(std::vector<std::string> inputs) : inputs_(std::move(inputs)) {}

  // Returns the temporary path to write to; it has the ending of `path`. Throws std::runtime_error with one line
  // where `path` cannot be written to, is an input, or was claimed before.
  const std::string& claim(const std::string& path);
  // The same for an image; throws also where its ending is none that images have.
  const std::string& claim_image(const std::string& path);

  // Gives all files their names.
  void commit();

 private:
  std::vector<std::string> inputs_;
  std::vector<std::filesystem::path> claimed_;
  std::vector<std::unique_ptr<image::AtomicFile>> files_;
};

// The part of a file name from its last dot on, in lower case: ".exr". Empty where there is none.
std::string ending_of(const std::string& path);

}  // namespace lkao::cli
