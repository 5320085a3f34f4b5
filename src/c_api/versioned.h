// Structs of callers whose headers are older or newer than the library: they begin with their size.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>

#include "c_api/errors.h"
#include "lkao/c/bvh.h"

namespace lkao::c_api {

// The size that a struct had when liblkao_c first had it. One that grows gets a specialisation with that size.
template <typename Struct>
inline constexpr std::size_t kFirstSize = sizeof(Struct);
template <>
inline constexpr std::size_t kFirstSize<lkao_build_options> = offsetof(lkao_build_options, cut_out_survey);

// What a struct's size may be beyond what this library knows; more is no size but what lay there.
inline constexpr std::size_t kLargestUnknown = 4096;

// Throws where the size cannot be one, or members that this library does not know are set.
template <typename Struct>
void check_size(const Struct* from, const char* name) {
  const std::size_t size = needed(from, name)->size;
  if (size < kFirstSize<Struct> || size > sizeof(Struct) + kLargestUnknown) {
    refuse(std::string(name) + "->size must be at least " + std::to_string(kFirstSize<Struct>) + " bytes, not " +
           std::to_string(size) + ": begin with the struct's LKAO_..._INIT");
  }
  const auto* const bytes = reinterpret_cast<const unsigned char*>(from);
  for (std::size_t i = sizeof(Struct); i < size; ++i) {
    if (bytes[i] == 0) continue;
    throw Error(LKAO_ERROR_UNSUPPORTED, std::string(name) + " has members set that lkao " + lkao_version() +
                                            " does not know: byte " + std::to_string(i) + " is not 0");
  }
}

// The caller's struct as this library knows it. Members that the caller does not know are those of `defaults`.
template <typename Struct>
Struct read(const Struct* from, const Struct& defaults, const char* name) {
  check_size(from, name);
  Struct result = defaults;
  std::memcpy(&result, from, std::min(from->size, sizeof(Struct)));
  result.size = sizeof(Struct);
  return result;
}

// The same for structs that may be NULL.
template <typename Struct>
Struct read_or_defaults(const Struct* from, const Struct& defaults, const char* name) {
  return from == nullptr ? defaults : read(from, defaults, name);
}

// Calls `body(struct, name)` for each of an array of structs, which are all as large as the caller's first.
template <typename Struct, typename Body>
void for_each(const Struct* first, std::size_t count, const Struct& defaults, const char* name, const Body& body) {
  if (count == 0) return;
  const std::size_t size = needed(first, name)->size;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string its_name = std::string(name) + "[" + std::to_string(i) + "]";
    const auto* const bytes = reinterpret_cast<const unsigned char*>(first) + i * size;
    const auto* const from = reinterpret_cast<const Struct*>(bytes);
    const Struct own = read(from, defaults, its_name.c_str());
    if (from->size != size) refuse(its_name + "->size must be that of " + name + "[0]");
    body(own, its_name);
  }
}

// Fills as much of the caller's struct as the caller knows. To be checked by check_size() before.
template <typename Struct>
void write(const Struct& value, Struct* to) {
  constexpr std::size_t kSizeEnd = sizeof(std::size_t);
  std::memcpy(reinterpret_cast<unsigned char*>(to) + kSizeEnd,
              reinterpret_cast<const unsigned char*>(&value) + kSizeEnd, std::min(to->size, sizeof(Struct)) - kSizeEnd);
}

}  // namespace lkao::c_api
