// EXT_mesh_gpu_instancing: one node that shows its mesh many times.
#pragma once

#include <vector>

#include <glm/mat4x4.hpp>

#include "scene/formats/gltf/accessors.h"

namespace lkao::scene::gltf {

// Where a node's mesh stands, seen from the node: once at the node itself where the extension is not used.
std::vector<glm::dmat4> read_instances(const Value& node, Accessors& accessors);

}  // namespace lkao::scene::gltf
