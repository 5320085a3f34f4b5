// Numbers out of bytes that need not be aligned.
#pragma once

#include <bit>
#include <cstring>

namespace lkao::scene::gltf {

static_assert(std::endian::native == std::endian::little, "glTF's numbers are little-endian, and read as they are");

template <typename Number>
Number load_number(const char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof(Number));
  return number;
}

}  // namespace lkao::scene::gltf
