// The number types of glTF's accessors.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lkao::scene::gltf {

// The values are the file's.
enum class ComponentType : std::uint16_t {
  int8 = 5120,
  uint8 = 5121,
  int16 = 5122,
  uint16 = 5123,
  uint32 = 5125,
  float32 = 5126,
};

std::size_t size_of(ComponentType type);

// Where a number of rows lie, the first at `data`, each `stride` bytes behind the one before, of `width` numbers each.
// They need not be aligned.
struct Rows {
  const char* data;
  std::size_t stride;
  std::size_t count;
  std::size_t width;
};

// Reads rows, one behind the other; integers as parts of their largest value where they are normalised.
void decode(const Rows& rows, ComponentType type, bool is_normalized, double* out);

// Integers only.
void decode(const Rows& rows, ComponentType type, std::uint32_t* out);

}  // namespace lkao::scene::gltf
