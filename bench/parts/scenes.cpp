#include "bench/parts/scenes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <utility>

#include <glm/vec2.hpp>

#include "bench/tiles.h"
#include "bvh/ray_box.h"
#include "scene/camera.h"
#include "scene/shapes.h"

namespace lkao::bench {
namespace {

constexpr int kImageWidth = 256, kImageHeight = 192;

StudyScene make_closed_scene() {
  constexpr int kRingCount = 256, kSegmentCount = 512;
  constexpr double kPi = std::numbers::pi;
  std::vector<glm::dvec2> profile = {{0, 0}};
  for (int ring = 1; ring < kRingCount; ++ring) {
    const double t = static_cast<double>(ring) / kRingCount;
    profile.emplace_back(std::sin(kPi * t) * (1 + 0.08 * std::sin(24 * kPi * t)), 3 * t);
  }
  profile.emplace_back(0, 3);
  scene::Mesh mesh;
  scene::add_revolved(mesh, {0, 0, 0}, profile, kSegmentCount,
                      [](double turns) { return 1 + 0.06 * std::sin(48 * kPi * turns); });
  const scene::Camera camera = scene::frame(scene::bounds_of(mesh), 4.0f / 3);
  return look_at("closed", std::move(mesh), {0.1f, 1.0f}, camera, kImageWidth, kImageHeight);
}

StudyScene make_scene(const std::string& name) {
  if (name == "closed") return make_closed_scene();
  return std::move(load_study_scenes({"", "", {name}, kImageWidth, kImageHeight}).front());
}

template <typename Item>
std::vector<Item> choose_evenly(const std::vector<Item>& items) {
  std::vector<Item> chosen;
  for (std::size_t i = 0; i < Surroundings::kCount; ++i) {
    chosen.push_back(items.at(i * items.size() / Surroundings::kCount));
  }
  return chosen;
}

// Parents before children.
void add_all_that_rays_meet(Surroundings& here) {
  const bvh::Layout& layout = here.occluders.layout();
  std::vector<bvh::BoxRay> rays;
  rays.reserve(static_cast<std::size_t>(here.rays.ray_count));
  for (int i = 0; i < here.rays.ray_count; ++i) rays.emplace_back(here.rays.ray(i));
  std::vector<std::uint32_t> reached = {0};
  for (std::size_t next = 0; next < reached.size(); ++next) {
    const bvh::Node& node = layout.nodes[reached[next]];
    if (!node.children[bvh::kWidth - 1].is_empty()) here.nodes.push_back(node);
    for (int i = 0; i < bvh::kWidth && !node.children[i].is_empty(); ++i) {
      const Bounds box = node.child_bounds(i);
      const auto meets_box = [&](const bvh::BoxRay& ray) { return bvh::may_meet(ray, here.rays.origin, box); };
      if (std::none_of(rays.begin(), rays.end(), meets_box)) continue;
      const bvh::ChildRef child = node.children[i];
      if (!child.is_leaf()) {
        reached.push_back(child.index());
      } else if (layout.leaves[child.index()].triangle_count() == bvh::kLeafWidth) {
        here.leaves.push_back(layout.leaves[child.index()]);
      }
    }
  }
}

Surroundings make_surroundings() {
  const MeasuredScene& scene = measured_scene("atrium");
  const SamplePattern& pattern = SamplePattern::standard(128);
  const float radius = scene.view.radii.back();
  const AmbientOcclusion ao(scene.occluders, pattern, {.radius = radius});
  Surroundings here{scene.occluders, radius, ao.rays(scene.tiles.front(), 0), {}, {}};
  add_all_that_rays_meet(here);
  here.nodes = choose_evenly(here.nodes);
  here.leaves = choose_evenly(here.leaves);
  return here;
}

}  // namespace

MeasuredScene::MeasuredScene(StudyScene scene)
    : view(std::move(scene)), tiles(choose_tiles(view.view, 2)), occluders(view.mesh.view()), oracle(view.mesh) {}

const MeasuredScene& measured_scene(const std::string& name) {
  static std::map<std::string, std::unique_ptr<const MeasuredScene>> scenes;
  auto& scene = scenes[name];
  if (!scene) scene = std::make_unique<const MeasuredScene>(make_scene(name));
  return *scene;
}

Accuracy find_accuracy(const MeasuredScene& scene, const AmbientOcclusion& ao, const std::vector<Receiver>& receivers) {
  std::vector<std::uint64_t> masks(receivers.size() * static_cast<std::size_t>(ao.pattern().word_count()));
  std::vector<std::uint64_t> expected(masks.size());
  const auto ray_count = static_cast<double>(ao.query(receivers, {.mask_words = masks}).ray_count);
  scene.oracle.query(ao, receivers, {.mask_words = expected});
  return {ray_count, static_cast<double>(reference::count_mismatched_rays(masks, expected)) / ray_count};
}

const Surroundings& surroundings() {
  static const Surroundings kSurroundings = make_surroundings();
  return kSurroundings;
}

}  // namespace lkao::bench
