// Image files of a rendering.
#pragma once

#include <string>

#include "method/batch.h"
#include "scene/camera.h"

namespace lkao::cli {

// What an EXR holds besides the channel "occlusion".
struct ImageLayers {
  bool bent_normals = false;  // bent.X, bent.Y, bent.Z
  bool depth = false;         // depth.Z: distance along the view axis, +infinity where nothing is seen
  bool normals = false;       // normal.X, normal.Y, normal.Z: of the receiver, towards the eye
  bool visibility = false;    // of a light: the channel "visibility", 1 - occlusion, in the place of "occlusion"

  bool any() const { return bent_normals || depth || normals; }
};

// Writes by the ending of `path`: .exr the float channels, .png the visibility to look at (no layers). In an EXR,
// pixels without a receiver hold occlusion 0 (visibility 1) and zero vectors, so that the channel can be composited as
// it is; their depth tells them apart. Throws std::runtime_error with one line where writing fails.
void write_rendering(const std::string& path, const scene::ReceiverImage& view, const method::Batch& batch,
                     const ImageLayers& layers);

}  // namespace lkao::cli
