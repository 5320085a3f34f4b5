// `--part K/N`, and what `lkao merge` makes of the files of all parts.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/method_options.h"
#include "cli/options.h"
#include "cli/part_file.h"
#include "cli/progress_bar.h"
#include "method/batch.h"
#include "method/method.h"

namespace CLI {
class App;
}

namespace lkao::cli {

struct PartOptions {
  std::optional<Part> part;                 // answer this one alone
  std::vector<std::string> arguments;       // PartHeader::arguments
  std::vector<std::string> merged;          // files of all parts: answer from these
  std::shared_ptr<PartWriter> writer = {};  // where there is a part

  // What is read: these files too.
  std::vector<std::string> with_merged(std::vector<std::string> inputs) const {
    inputs.insert(inputs.end(), merged.begin(), merged.end());
    return inputs;
  }
};

// --part; and, not shown, --merged, by which `lkao merge` hands over its files.
void add_part_options(CLI::App& app, PartOptions& options);

// Throws std::invalid_argument where the method answers no receivers one by one.
void check_part(const PartOptions& options, const MethodOptions& method);

// "atrium.exr.3of8.part": where a part of the run whose output is "atrium.exr" goes.
std::string part_path(const std::string& output, const Part& part);

// The method, answering a part, or from parts, where that is asked for. `own_object`: of every object by itself
// (own_objects.h). The options must outlive it.
std::unique_ptr<method::Method> open_method(const MethodOptions& method, const PartOptions& parts,
                                            bool own_object = false);

// A run of one part, `compute`'s, whose options must be those that `parts` is of: its file, and the report. `inputs`
// are what it reads.
void answer_part(PartOptions& parts, const std::string& output, const CommonOptions& common,
                 std::vector<std::string> inputs, const std::function<method::Batch(ProgressBar&)>& compute);

}  // namespace lkao::cli
