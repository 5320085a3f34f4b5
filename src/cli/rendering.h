// What a rendering computes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "cli/batch.h"
#include "cli/camera_options.h"
#include "cli/lod_option.h"
#include "cli/options.h"
#include "cli/parse.h"
#include "cli/progress_bar.h"
#include "cli/raster_method.h"
#include "cli/render_images.h"
#include "cli/scene_input.h"
#include "scene/camera.h"

namespace lkao::cli {

struct RenderingOptions {
  std::string scene;
  Size size;
  Method method = Method::bvh;
  bool reference = false;
  ImageLayers layers;
  CameraOptions camera;
  OcclusionOptions occlusion;
  RasterOptions raster;
  std::optional<LodOption> lod;
};

struct Rendering {
  SceneInput scene;
  scene::Camera camera;
  std::optional<lod::Chain> chain;  // where there are levels of detail
  double lod_seconds = 0;
  double build_seconds = 0;
  double embree_build_seconds = 0;
  double camera_seconds = 0;
  scene::ReceiverImage view;
  // Receiver k is pixel k. Pixels that see nothing are no invalid receivers.
  Batch batch;
  std::optional<RasterReport> raster;
};

// Throws std::exception with one line for whatever is wrong.
Rendering compute_rendering(const RenderingOptions& options, ProgressBar& progress);

}  // namespace lkao::cli
