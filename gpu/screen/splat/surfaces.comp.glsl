#version 450 core
// One layer of the scene: its receivers (of the first layer), and the spheres that its pixels stand for.
//
// Based on: P. Shanmugam, O. Arikan, "Hardware Accelerated Ambient Occlusion Techniques on GPUs", I3D 2007, Sec. 4.1.
// Differs from the paper: it leaves open how large a pixel's sphere is. Here its radius is a share of the pixel's width
// at its distance, and it touches the surface from behind, so that nothing of a plane is above its own horizon.
#define LKAO_DOUBLE 0
#include "gpu/screen/splat/splat_block.h"
#include "gpu/screen/splat/units.h"
#include "gpu/screen/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba32f) writeonly uniform image2DArray receivers;
layout(binding = 1, rgba32f) writeonly uniform image2DArray pixel_spheres;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (is_outside(pixel)) return;
  Surface surface;
  bool is_there = find_surface(pixel, surface);
  if (pass.layer == 0) {
    imageStore(receivers, ivec3(pixel, LKAO_SCREEN_POSITION), is_there ? vec4(surface.position, 1) : vec4(0));
    imageStore(receivers, ivec3(pixel, LKAO_SCREEN_NORMAL), is_there ? vec4(surface.normal, 0) : vec4(0));
  }
  vec4 sphere = vec4(0);  // of radius 0: none
  float width = is_there ? pixel_width(surface.position) : 0.0;
  if (width > 0.0) {
    float radius = pass.pixel_sphere_radius * width;
    sphere = vec4(surface.position - radius * surface.geometric_normal, radius);
  }
  imageStore(pixel_spheres, ivec3(pixel, pass.layer), sphere);
}
