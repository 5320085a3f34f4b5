// Mesh files out: PLY, plain or with occlusion.
//
// A mesh with an origin is written less it, since floats do not hold more; a line "comment origin X Y Z" of the header
// says what was taken away. All files are binary and little-endian.
#pragma once

#include <ostream>
#include <span>

#include "scene/mesh.h"
#include "scene/occlusion_colour.h"

namespace lkao::scene {

// float x y z, faces as lists of vertex indices; read_mesh_file gets the mesh back bit for bit. The caller checks the
// stream.
void write_ply(std::ostream& out, const Mesh& mesh);

struct OcclusionProperties {
  ColourCoding coding = ColourCoding::srgb;
  bool quality = false;
};

// As above, and for every vertex: float occlusion (1 = blocked), uchar red green blue (the grey of the visibility
// 1 - occlusion), and perhaps float quality (the visibility, as MeshLab has it). `occlusion` has an entry for every
// vertex. Throws std::invalid_argument where its size is wrong. The caller checks the stream.
void write_ply(std::ostream& out, const Mesh& mesh, std::span<const float> occlusion,
               const OcclusionProperties& properties = {});

// The same for every face, behind its list.
void write_ply_of_faces(std::ostream& out, const Mesh& mesh, std::span<const float> occlusion,
                        const OcclusionProperties& properties = {});

}  // namespace lkao::scene
