// Mesh files out: PLY, plain or with occlusion per vertex.
#pragma once

#include <ostream>
#include <span>

#include "scene/mesh.h"

namespace lkao::scene {

// Binary little-endian PLY: float x y z, faces as lists of vertex indices; read_mesh_file gets the mesh back bit for
// bit. The caller checks the stream.
void write_ply(std::ostream& out, const Mesh& mesh);

// Binary little-endian PLY: float x y z, float occlusion (1 = blocked), uchar red green blue (the grey of the
// visibility 1 - occlusion, sRGB-encoded), faces as lists of vertex indices. `occlusion` has an entry for every vertex.
// Throws std::invalid_argument where its size is wrong. The caller checks the stream.
void write_ply(std::ostream& out, const Mesh& mesh, std::span<const float> occlusion);

}  // namespace lkao::scene
