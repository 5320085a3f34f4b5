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

Json vector_json(const glm::dvec3& vector);
// In the file's coordinates.
Json position_json(const glm::vec3& position, const glm::dvec3& origin);

// The rows and keys that renderings and bakes share.
void add_scene_row(Table& table, const SceneInput& scene);
void add_batch_rows(Table& table, const method::MethodKind& kind, const method::Batch& batch, double occlusion_mean);
void add_batch_keys(Json& document, const method::MethodKind& kind, const method::Batch& batch, double occlusion_mean);
void add_setting_keys(Json& document, const OcclusionOptions& options);
void add_remark_rows(Table& table, const method::Remarks& remarks);
void add_remark_keys(Json& document, const method::Remarks& remarks);
void add_scene_keys(Json& document, const SceneInput& scene);
// Nothing where nothing surrounds the scene and it was not turned round.
void add_surroundings_row(Table& table, const SceneOptions& options, const SceneInput& scene);
void add_surroundings_keys(Json& document, const SceneOptions& options, const SceneInput& scene);

// A line on stderr where most receivers are fully blocked. Not where the radius is longer than the scene: then rooms
// are rightly dark. `what` names the receivers: "vertices".
void report_fully_blocked(const SceneInput& scene, const std::string& what, const method::Batch& batch, double radius);

}  // namespace lkao::cli
