// What a rendering computes.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/camera_options.h"
#include "cli/light_option.h"
#include "cli/lod_option.h"
#include "cli/method_options.h"
#include "cli/options.h"
#include "cli/parse.h"
#include "cli/parts.h"
#include "cli/progress_bar.h"
#include "cli/render_images.h"
#include "cli/scene_input.h"
#include "cli/scene_options.h"
#include "method/batch.h"
#include "scene/camera.h"

namespace lkao::cli {

struct RenderingOptions {
  SceneOptions scene;
  Size size;
  MethodOptions method;
  bool reference = false;
  ImageLayers layers;
  CameraOptions camera;
  OcclusionOptions occlusion;
  std::optional<LodOption> lod;
  std::optional<LightOption> light;
  std::optional<scene::NormalSource> normals;
  PartOptions parts;
};

struct Rendering {
  SceneInput scene;
  double radius = 0;  // in the scene's unit; infinite where a light is asked about
  scene::Camera camera;
  scene::NormalSource normals = scene::NormalSource::facet;
  std::optional<lod::Chain> chain;  // where there are levels of detail
  double lod_seconds = 0;
  double build_seconds = 0;  // of what methods share
  // Of what a method builds for itself: its word, and how long it took.
  std::vector<std::pair<std::string, double>> own_build_seconds;
  double camera_seconds = 0;
  scene::ReceiverImage view;
  // Receiver k is pixel k. Pixels that see nothing are no invalid receivers.
  method::Batch batch;
  method::Remarks remarks;
};

// Throws std::exception with one line for whatever is wrong.
Rendering compute_rendering(const RenderingOptions& options, ProgressBar& progress);

}  // namespace lkao::cli
