// The table of all objects that C callers hold.
//
// A handle is a number that looks like a pointer: the place of its object in the table, its kind, and which of the
// objects that had this place over time it is. So a handle that was destroyed, or never was one, is told without a look
// at memory that is no longer there.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lkao::c_api {

enum class Kind : std::uint8_t { pattern = 1, table, bvh, scene, ao, neighbourhood, bundles, shadows, sky };

// Enters an object; throws std::bad_alloc where there is no more room.
std::uintptr_t enter(Kind kind, void* object);

// The object of a handle; throws an Error that names the argument where the handle is none of that kind. Takes some
// nanoseconds and no lock.
void* find(Kind kind, std::uintptr_t handle, const char* argument);

// The same, and takes it out.
void* take(Kind kind, std::uintptr_t handle, const char* argument);

std::size_t live_count();

}  // namespace lkao::c_api
