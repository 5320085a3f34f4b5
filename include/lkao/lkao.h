// lkao: Laine-Karras bitmask ambient occlusion on the CPU. This header brings in the whole CPU library;
// link lkao::lkao.
//
//   lkao::OccluderBvh occluders({positions, triangles});
//   lkao::AmbientOcclusion ao(occluders, lkao::SamplePattern::standard(128), {.radius = 2.0f});
//   float visibility = 1 - ao.query({.position = p, .normal = n}, pixel).occlusion;
//
// Words:   receiver (the point asked about), occluder (a triangle), AO radius (the longest ray), sample
//          pattern (the rays around +z), ray i = direction x length, occlusion mask (bit i: ray i is blocked).
//          `occlusion` is 1 where everything is blocked; visibility = 1 - occlusion.
// Spaces:  positions, normals and results are in world space, right-handed; patterns are around +z. Scenes far from
//          zero: positions in double, less an origin near them (PositionView, OccluderBvh::origin).
// Units:   any, the same for positions and radius; angles are in radians.
// Threads: finished objects are immutable and shared freely; batches and builds run in parallel with oneTBB in
//          the caller's arena. Results do not depend on the number of threads.
// Errors:  wrong arguments throw std::invalid_argument naming the argument and its value. Bad triangles are
//          dropped and counted (BuildReport), bad receivers answer NaN and are counted (QueryReport).
//          The library never prints and never aborts.
#pragma once

#include "lkao/ambient_occlusion.h"
#include "lkao/area_light.h"
#include "lkao/cut_outs.h"
#include "lkao/index_view.h"
#include "lkao/isa.h"
#include "lkao/kernel.h"
#include "lkao/mesh_instance.h"
#include "lkao/neighbourhood.h"
#include "lkao/occluder_bvh.h"
#include "lkao/occluder_scene.h"
#include "lkao/occlusion_mask.h"
#include "lkao/plane_mask_table.h"
#include "lkao/position_view.h"
#include "lkao/progress.h"
#include "lkao/ray_bundles.h"
#include "lkao/receiver.h"
#include "lkao/receiver_rays.h"
#include "lkao/requirements.h"
#include "lkao/sample_pattern.h"
#include "lkao/sky_visibility.h"
#include "lkao/soft_shadows.h"
#include "lkao/version.h"
#include "lkao/weighting.h"
