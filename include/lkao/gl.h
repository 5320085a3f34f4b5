// The OpenGL side of the library; link lkao::gl, which needs neither Embree nor TBB.
//
// Outside the umbrella lkao.h, so that users of the CPU library need nothing of OpenGL. Needs OpenGL 4.5 core. Names of
// OpenGL's objects are plain integers here, so that no particular loader is needed.
//
//   lkao::gl::MaskPass pass;                                        // with the renderer's context current
//   pass.set_table(lkao::PlaneMaskTable(lkao::SamplePattern::standard(128)));
//   lkao::gl::Occluders occluders(positions, triangles);            // for each mesh; shared by all passes
//   each frame:
//     occluders.update_positions(positions);                        // where the mesh moves
//     pass.draw(occluders, {.width = w, .height = h, .depth = depth_texture, .normals = normal_texture},
//               {view, projection}, {.radius = 2.0f});
//     pass.resolve({.occlusion = {r8_texture}});
//
// Or without rays, on the same occluders and G-buffer: lkao::gl::VolumePass. On the G-buffer alone, as screens show it:
// HorizonPass, VaoPass, AlchemyPass; with spheres that stand for the scene: SplatPass.
#pragma once

#include "lkao/gl/alchemy_pass.h"
#include "lkao/gl/bilateral_filter.h"
#include "lkao/gl/context.h"
#include "lkao/gl/frame.h"
#include "lkao/gl/horizon_pass.h"
#include "lkao/gl/mask_pass.h"
#include "lkao/gl/occluders.h"
#include "lkao/gl/splat_pass.h"
#include "lkao/gl/status.h"
#include "lkao/gl/vao_pass.h"
#include "lkao/gl/volume_pass.h"
