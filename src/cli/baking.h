// What a bake computes.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "bake/places.h"
#include "cli/method_options.h"
#include "cli/options.h"
#include "cli/parts.h"
#include "cli/progress_bar.h"
#include "cli/scene_input.h"
#include "method/batch.h"

namespace lkao::cli {

enum class Filter {
  none,           // the limit of occlusion at the vertex
  least_squares,  // what comes nearest to samples of the whole surface
};

struct BakingOptions {
  SceneOptions scene;
  glm::vec3 up{0, 1, 0};  // for the ground
  OcclusionOptions occlusion;
  MethodOptions method;  // the traversal
  std::optional<scene::NormalSource> normals;
  bake::Per per = bake::Per::vertex;
  Filter filter = Filter::none;
  PartOptions parts;
};

struct Baking {
  SceneInput scene;   // its vertices split where corners differ
  double radius = 0;  // in the scene's unit
  double build_seconds = 0;
  scene::NormalSource normals = scene::NormalSource::facet;
  std::size_t receiver_count = 0;  // valid ones
  // Of the receivers, but its occlusion is that of what was asked for: of each vertex, or each face. NaN where there is
  // none.
  method::Batch batch;
  std::size_t bare_count = 0;  // of these
  method::Remarks remarks;
};

// Throws std::exception with one line for whatever is wrong.
Baking compute_baking(const BakingOptions& options, ProgressBar& progress);

}  // namespace lkao::cli
