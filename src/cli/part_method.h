// Methods that answer a part of the receivers, and that have the answers of all parts.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/part_file.h"
#include "method/method.h"

namespace lkao::cli {

// Answers its share of every batch by `method`, and writes the answers; those to all other receivers are NaN. What one
// receiver gets depends on nothing but the scene, the question, the receiver and its index, so it is what the whole run
// would give, bit for bit. The writer must outlive it.
std::unique_ptr<method::Method> record_part(std::unique_ptr<method::Method> method, PartWriter& writer);

// Answers from the files of all parts of one run, in any order. Throws std::runtime_error with one line where one is
// missing, is there twice, or is of another run; and from answer() where they are of another scene.
std::unique_ptr<method::Method> replay_parts(const method::Abilities& abilities, const std::vector<std::string>& paths);

// Opens the files and puts them in order. Throws as replay_parts() does.
std::vector<PartReader> open_parts(const std::vector<std::string>& paths);

}  // namespace lkao::cli
