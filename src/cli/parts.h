// `--part K/N`, and what `lkao merge` makes of the files of all parts.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/json_output.h"
#include "cli/method_options.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/part_file.h"
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

// The method, answering a part, or from parts, where that is asked for. The options must outlive it.
std::unique_ptr<method::Method> open_method(const MethodOptions& method, const PartOptions& parts);

// Claims the file of the part among the outputs, and begins it.
std::shared_ptr<PartWriter> begin_part(const PartOptions& parts, const std::string& output, OutputFiles& outputs);

// Ends a run that answered one part: its file, and the report.
void end_part(const PartOptions& parts, const std::string& output, const method::Batch& batch,
              const CommonOptions& common, const JsonOutput& json);

}  // namespace lkao::cli
