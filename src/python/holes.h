// Triangles with holes, as Python keeps them: those of a file, or of arrays.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "scene/holes.h"

namespace lkao::python {

// Shared with what is made of it; never null.
struct MeshHoles {
  std::shared_ptr<const scene::Holes> holes;
};

// Null where there are none. Throws std::invalid_argument where they are of another number of triangles.
std::shared_ptr<const scene::Holes> holes_of(const MeshHoles* holes, std::size_t triangle_count);

// As scene::DecodeAlpha.
scene::AlphaImage decode_alpha(const std::string& name, std::string_view bytes, scene::AlphaOf what);

}  // namespace lkao::python
