// Occlusion as textures of a mesh.
//
//   TextureLayout, find_charts -> cover_tile -> make_receivers -> (a method) -> texels      bake_texels
//                                                      grow -> level_seams -> grow -> flood  finish_texture
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "bake/texture_map.h"
#include "bake/texture_options.h"
#include "lkao/ambient_occlusion.h"
#include "lkao/progress.h"
#include "scene/corner_normals.h"

namespace lkao::bake {

// Answers receivers; receiver k has index first_index + k. Outputs as of AmbientOcclusion::query: occlusion, and bent
// normals where they are asked for. Called in one thread at a time, with some 10^4 receivers.
using Ask = std::function<void(std::span<const Receiver>, const QueryOutputs&, std::uint64_t first_index)>;

// Every `count`th tile of texels, beginning with number `index`: shares of the work for several machines. Texels of
// other parts stay unknown.
struct TexturePart {
  std::size_t index = 0, count = 1;
};

struct TextureBake {
  std::vector<TextureMap> maps;  // one, or one for each UDIM tile that the mesh reaches, by number
  TextureReport report;
};

// The values of texels: means over their receivers, weighted by area. A receiver's index is made of the texel's tile
// and its number in there, so that parts, threads and the size of what is asked at once change no bit. `occluders`: the
// box around all that blocks. `progress` counts texels, from 0 on.
//
// In memory are the maps (5 bytes a texel, 12 more with bent normals), and the receivers of up to 16 tiles of
// 128 x 128 texels. In parallel, in the TBB arena of the caller, as far as `ask` is.
//
// Throws std::invalid_argument where an option is out of range, the part is none of its count, or no triangle to bake
// has texture coordinates; Cancelled where `progress` stops it; and what `ask` throws.
TextureBake bake_texels(const scene::CornerNormals& normals, const Bounds& occluders, const TextureOptions& options,
                        const Ask& ask, const TexturePart& part = {}, const Progress& progress = {});

// Levels the seams, lets charts grow by the margin and floods the rest: once all texels are there. `progress` counts
// steps, some of which take seconds for a map of 8192 x 8192 texels; where it stops the call (Cancelled), the bake is
// half finished and of no more use.
void finish_texture(const scene::CornerNormals& normals, const TextureOptions& options, TextureBake& bake,
                    const Progress& progress = {});

// Both; `progress` counts texels, and while the maps are finished is told that all are there. Adds to the memory some
// 1000 bytes for each texel along a seam, and 2 for each texel (6 with bent normals).
TextureBake bake_texture(const scene::CornerNormals& normals, const Bounds& occluders, const TextureOptions& options,
                         const Ask& ask, const Progress& progress = {});

}  // namespace lkao::bake
