// What Embree says when something fails, as an exception with one line.
#pragma once

#include "scene/embree.h"

namespace lkao::reference {

// `config` as of rtcNewDevice. Throws std::runtime_error.
scene::embree::Device make_device(const char* config);

// Throws std::runtime_error, naming the step, where the device had an error since it was last asked.
void check(RTCDevice device, const char* step);

}  // namespace lkao::reference
