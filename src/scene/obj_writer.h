// Mesh files out: OBJ with colours of vertices.
#pragma once

#include <ostream>
#include <span>

#include "scene/mesh.h"
#include "scene/occlusion_colour.h"

namespace lkao::scene {

// Lines "v x y z r g b" and "f i j k". Coordinates are those of the file that the mesh came from, its origin added,
// with all digits. `occlusion` has an entry for every vertex. Throws std::invalid_argument where its size is wrong. The
// caller checks the stream.
void write_obj(std::ostream& out, const Mesh& mesh, std::span<const float> occlusion,
               ColourCoding coding = ColourCoding::srgb);

}  // namespace lkao::scene
