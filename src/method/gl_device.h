// What all methods that draw with OpenGL have in common: their device and how it is told of. A thread has one of these
// methods open at a time.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "method/gl_words.h"
#include "method/settings.h"

namespace lkao::method {

const Setting& device_setting();

// Before the context is made. A rasteriser on the CPU then uses as many threads as the caller's TBB arena, unless the
// environment says otherwise.
gl::Device prepare_device(const Settings& settings);

// Renderer, version, and whether that is the CPU; for programs and for people.
nlohmann::ordered_json device_keys(const gl::HeadlessContext& context);
std::string device_text(const gl::HeadlessContext& context);

}  // namespace lkao::method
