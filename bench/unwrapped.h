// Texture coordinates for scenes that have none.
#pragma once

#include "scene/mesh.h"

namespace lkao::bench {

// Charts of connected triangles that face along the same axis, seen along it, in equal scale and packed by shelves,
// with gaps of 4 texels of a map of `size` x `size`. Where a chart has several storeys, they overlap. Good enough to
// measure a bake; not to look at. Triangles must be usable.
void unwrap(scene::Mesh& mesh, int size);

}  // namespace lkao::bench
