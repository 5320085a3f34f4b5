// A small renderer on Embree, and what it takes to give it lkao: the lines marked "lkao".
//
//   host_renderer builtin:atrium --ao both -o atrium.png
//   host_renderer builtin:atrium --ao both --copies 3 --light 0,8,0,1 -o lit.png
//
// Camera rays find the point that each pixel sees. Its ambient occlusion is the share of cosine-weighted shadow rays
// that are blocked within a radius. With `--ao embree` the renderer casts them one after the other, as it always did;
// with `--ao lkao` one query answers all of them; with `--ao both` it does one after the other, and compares. With
// `--light` the picture is the share of a spherical light that each point sees, found in the same two ways. The scene
// may stand in several places, as instances.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <lkao/lkao.h>  // lkao
#include <tbb/parallel_for.h>
#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "image/image.h"
#include "image/metrics.h"
#include "method/radius.h"
#include "method/stopwatch.h"
#include "reference/embree_instances.h"
#include "reference/embree_scene.h"
#include "scene/builtin.h"
#include "scene/load.h"

namespace {

namespace embree = lkao::scene::embree;

struct Options {
  std::string scene = "builtin:atrium", ao = "embree", radius, output;
  int ray_count = 128, width = 640, height = 480, copies = 1;
  std::vector<float> light;  // place and radius; empty: none
};

// The renderer's scene: a mesh in one or several places, and Embree over it.
class Scene {
 public:
  Scene(const lkao::scene::Mesh& mesh, const lkao::Bounds& bounds, int copies) : mesh_(mesh) {
    for (int i = 0; i < copies; ++i) {
      glm::mat4x3 to_world(i % 2 == 0 ? 1.0f : -1.0f);  // every other one is upside down and mirrored
      to_world[3].x = 1.1f * static_cast<float>(i) * (bounds.upper.x - bounds.lower.x);
      instances_.push_back({0, to_world});
    }
    if (copies == 1) {
      one_.emplace(mesh.view(), false);
    } else {
      several_.emplace(std::span(&mesh, 1), instances_, false);
    }
  }

  RTCScene embree() const { return one_ ? one_->plain() : several_->scene(); }
  const std::vector<lkao::OccluderInstance>& instances() const { return instances_; }

  glm::vec3 corner(const RTCHit& hit, int which) const {
    const std::uint32_t primitive = one_ ? one_->primitive(hit.primID) : hit.primID;
    const glm::mat4x3& to_world = instances_[one_ ? 0 : hit.instID[0]].to_world;
    return to_world * glm::vec4(mesh_.positions[mesh_.triangles[primitive][which]], 1);
  }

 private:
  const lkao::scene::Mesh& mesh_;
  std::vector<lkao::OccluderInstance> instances_;
  std::optional<lkao::reference::EmbreeScene> one_;
  std::optional<lkao::reference::EmbreeInstances> several_;
};

// What a pixel sees. The normal is the triangle's, turned to the eye; zero where the pixel sees nothing.
struct SurfacePoint {
  glm::vec3 position{0}, normal{0};
};

SurfacePoint trace(const Scene& scene, const glm::vec3& eye, const glm::vec3& direction) {
  RTCRayHit query{};
  query.ray.org_x = eye.x, query.ray.org_y = eye.y, query.ray.org_z = eye.z;
  query.ray.dir_x = direction.x, query.ray.dir_y = direction.y, query.ray.dir_z = direction.z;
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.mask = ~0u;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  embree::RayQuery rays;
  embree::intersect(scene.embree(), rays, query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  const glm::vec3 a = scene.corner(query.hit, 0);
  const glm::vec3 u = scene.corner(query.hit, 1) - a, v = scene.corner(query.hit, 2) - a;
  const glm::vec3 normal = glm::normalize(glm::cross(u, v));
  return {a + query.hit.u * u + query.hit.v * v, glm::dot(normal, direction) < 0 ? normal : -normal};
}

std::vector<SurfacePoint> trace_camera_rays(const Scene& scene, const lkao::scene::Camera& camera, int width,
                                            int height) {
  const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
  const float half_width = std::tan(0.5f * glm::radians(camera.fov));
  const glm::vec3 right = half_width * glm::normalize(glm::cross(forward, camera.up));
  const glm::vec3 up = glm::cross(right, forward);
  std::vector<SurfacePoint> points(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  tbb::parallel_for(0, width * height, [&](int pixel) {
    const float x = static_cast<float>(2 * (pixel % width) + 1 - width) / static_cast<float>(width);
    const float y = static_cast<float>(height - 2 * (pixel / width) - 1) / static_cast<float>(width);
    points[static_cast<std::size_t>(pixel)] = trace(scene, camera.eye, forward + x * right + y * up);
  });
  return points;
}

// The renderer's loop: a shadow ray for every sample. The rays are those that lkao casts, so that the images can be
// compared; making them costs what any sampler costs.
lkao::ReceiverOcclusion cast_shadow_rays(const Scene& scene, const lkao::ReceiverRays& rays) {
  embree::RayQuery query;
  lkao::ReceiverOcclusion answer;
  for (int i = 0; i < rays.ray_count; ++i) {
    if (!rays.cast.test(i)) continue;
    const glm::vec3 &from = rays.origin, along = rays.ray(i);
    RTCRay ray{from.x, from.y, from.z, 0, along.x, along.y, along.z, 0, 1, ~0u, 0, 0};
    embree::find_blocked(scene.embree(), query, ray);
    if (ray.tfar < 0) answer.mask.set(i);
  }
  answer.occlusion = static_cast<float>(answer.mask.count()) / static_cast<float>(rays.cast.count());
  return answer;
}

// What is hidden of a light whose points the rays go to: those below the horizon, and what is blocked.
float hidden_share(const lkao::ReceiverRays& rays, const lkao::OcclusionMask& blocked) {
  return 1 - static_cast<float>((rays.cast & ~blocked).count()) / static_cast<float>(rays.ray_count);
}

struct AoImage {
  std::vector<float> occlusion;            // NaN where a pixel sees nothing
  std::vector<lkao::OcclusionMask> masks;  // for the comparison
  double seconds = 0;
};

// Runs the integrator for every point, on all threads.
template <typename Integrator>
AoImage render(const char* name, const std::vector<SurfacePoint>& points, const Integrator& integrator) {
  AoImage image;
  image.occlusion.resize(points.size(), std::numeric_limits<float>::quiet_NaN());
  image.masks.resize(points.size());
  const lkao::method::Stopwatch watch;
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t pixel) {
    if (points[pixel].normal == glm::vec3(0)) return;
    const lkao::ReceiverOcclusion answer = integrator(points[pixel], pixel);
    image.occlusion[pixel] = answer.occlusion;
    image.masks[pixel] = answer.mask;
  });
  image.seconds = watch.seconds();
  fmt::print("{:6} {:9.3f} s\n", name, image.seconds);
  return image;
}

void print_difference(const AoImage& embree, const AoImage& lkao, int ray_count) {
  int mismatched = 0, pixel_count = 0;
  for (std::size_t i = 0; i < lkao.masks.size(); ++i) {
    const lkao::OcclusionMask &a = embree.masks[i], &b = lkao.masks[i];
    mismatched += ((a & ~b) | (b & ~a)).count();
    pixel_count += !std::isnan(lkao.occlusion[i]);
  }
  const lkao::image::Metrics metrics = lkao::image::compare(embree.occlusion, lkao.occlusion);
  fmt::print("lkao is {:.2f} times as fast\n", embree.seconds / lkao.seconds);
  fmt::print("image difference: mean {:.2g}, largest {:.2g}; {} of {} rays mismatched\n", metrics.mae,
             metrics.max_error, mismatched, std::int64_t{pixel_count} * ray_count);
}

void run(const Options& options) {
  const lkao::scene::Mesh mesh = lkao::scene::load(options.scene);
  const lkao::Bounds bounds = lkao::scene::bounds_of(mesh);
  const Scene scene(mesh, bounds, options.copies);
  const float radius = options.radius.empty()
                           ? lkao::scene::suggest_radii(bounds).large
                           : static_cast<float>(lkao::method::parse_radius(options.radius).in(bounds));
  const lkao::scene::Camera camera =
      options.scene.starts_with("builtin:")
          ? lkao::scene::builtin_scene(options.scene.substr(8)).camera
          : lkao::scene::frame(bounds, static_cast<float>(options.width) / static_cast<float>(options.height));
  const std::vector<SurfacePoint> points = trace_camera_rays(scene, camera, options.width, options.height);

  const lkao::OccluderScene occluders({lkao::OccluderBvh(mesh.view())}, scene.instances());  // lkao, once a scene
  const lkao::SamplePattern& pattern = lkao::SamplePattern::standard(options.ray_count);     // lkao
  const lkao::AmbientOcclusion ao(occluders, pattern, {.radius = radius});                   // lkao
  std::optional<lkao::SoftShadows> shadows;
  if (!options.light.empty()) {
    const std::vector<float>& light = options.light;
    shadows.emplace(occluders, lkao::SphereLight{{light[0], light[1], light[2]}, light[3]}, pattern);  // lkao
  }

  AoImage by_embree, by_lkao;
  if (options.ao != "lkao") {
    by_embree = render("embree", points, [&](const SurfacePoint& point, std::size_t pixel) {
      if (!shadows) return cast_shadow_rays(scene, ao.rays({point.position, point.normal}, pixel));
      const lkao::ReceiverRays rays = shadows->rays({point.position, point.normal}, pixel);
      lkao::ReceiverOcclusion answer = cast_shadow_rays(scene, rays);
      answer.occlusion = hidden_share(rays, answer.mask);
      return answer;
    });
  }
  if (options.ao != "embree") {
    by_lkao = render("lkao", points, [&](const SurfacePoint& point, std::size_t pixel) {
      const lkao::Receiver receiver{point.position, point.normal};
      if (!shadows) return ao.query(receiver, pixel);                       // lkao, instead of cast_shadow_rays()
      const lkao::LightVisibility light = shadows->query(receiver, pixel);  // lkao, likewise
      return lkao::ReceiverOcclusion{1 - light.visibility, {}, light.blocked};
    });
  }
  if (options.ao == "both") print_difference(by_embree, by_lkao, options.ray_count);
  if (options.output.empty()) return;
  const std::vector<float>& occlusion = (options.ao == "embree" ? by_embree : by_lkao).occlusion;
  lkao::image::write_image(options.output,
                           lkao::image::visibility_preview({options.width, options.height, {"occlusion"}, occlusion}));
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Renders ambient occlusion on Embree, with or without lkao.", "host_renderer");
  app.add_option("scene", options.scene, "mesh file or builtin:NAME")->capture_default_str();
  app.add_option("--ao", options.ao)->check(CLI::IsMember({"embree", "lkao", "both"}))->capture_default_str();
  app.add_option("--radius", options.radius,
                 "AO radius: a length, 5% of the scene's diagonal, or inf (default: one that suits the scene)");
  app.add_option("--copies", options.copies, "of the scene, in a row")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--light", options.light, "x,y,z,radius of a sphere: its soft shadows instead of ambient occlusion")
      ->delimiter(',')
      ->expected(4);
  app.add_option("--rays", options.ray_count, "a pixel, 1 to 1024")->capture_default_str();
  app.add_option("--width", options.width)->check(CLI::Range(1, 8192))->capture_default_str();
  app.add_option("--height", options.height)->check(CLI::Range(1, 8192))->capture_default_str();
  app.add_option("-o,--output", options.output, "PNG file of the visibility");
  CLI11_PARSE(app, argc, argv);
  try {
    run(options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "host_renderer: {}\n", error.what());
    return 2;
  }
}
