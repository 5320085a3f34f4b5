// What a run found, for people (a table on stdout) and for programs (JSON).
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "cli/json_output.h"
#include "cli/options.h"
#include "cli/scene_input.h"
#include "method/batch.h"
#include "method/list.h"

namespace lkao::cli {

// Rows of a label and a text, aligned.
class Table {
 public:
  void add(std::string label, std::string text) { rows_.emplace_back(std::move(label), std::move(text)); }
  void print() const;

 private:
  std::vector<std::pair<std::string, std::string>> rows_;
};

// 1234567 as "1,234,567".
std::string grouped(std::uint64_t count);

Json vector_json(const glm::vec3& vector);

// The rows and keys that renderings and bakes share.
void add_scene_row(Table& table, const SceneInput& scene);
void add_batch_rows(Table& table, const method::MethodKind& kind, const method::Batch& batch);
void add_batch_keys(Json& document, const method::MethodKind& kind, const method::Batch& batch);
void add_setting_keys(Json& document, const OcclusionOptions& options);
void add_remark_rows(Table& table, const method::Remarks& remarks);
void add_remark_keys(Json& document, const method::Remarks& remarks);
void add_scene_keys(Json& document, const SceneInput& scene);

}  // namespace lkao::cli
