// The method on the command line: which one, and its settings.
#pragma once

#include <string_view>

#include "cli/options.h"
#include "method/list.h"

namespace lkao::cli {

struct MethodOptions {
  const method::MethodKind* kind = &method::traversal();
  method::Settings settings;
};

// --method, and an option for every setting of any method.
void add_method_options(CLI::App& app, MethodOptions& options);

// Throws std::runtime_error where this program was built without the method, std::invalid_argument where a setting is
// none of the method's.
void check_method(const MethodOptions& options);

// Throws std::invalid_argument where the method, with its settings, cannot do what `option` asks for: "--lod is for
// --method bvh and raster, not for --method embree".
void require_ability(const MethodOptions& options, bool method::Abilities::*ability, std::string_view option);

// Not every method takes every radius, falloff, weighting and --min-distance.
void check_question(const MethodOptions& options, const OcclusionOptions& occlusion);

}  // namespace lkao::cli
