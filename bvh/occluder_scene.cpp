#include "lkao/occluder_scene.h"

#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "bvh/bounds.h"
#include "bvh/scene_layout.h"
#include "lut/coordinates.h"

namespace lkao {
namespace {

using bvh::Placement;
using bvh::SceneLayout;

bool is_finite(const glm::mat4x3& m) {
  return lut::is_finite(m[0]) && lut::is_finite(m[1]) && lut::is_finite(m[2]) && lut::is_finite(m[3]);
}

bool is_finite(const glm::dmat4x3& m) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) {
      if (!std::isfinite(m[column][row])) return false;
    }
  }
  return true;
}

// `name`: of what it is part of, in messages.
Placement make_checked(const SceneLayout& scene, std::uint32_t mesh, const glm::mat4x3& to_world, std::uint32_t groups,
                       const char* name, std::size_t number) {
  const auto refuse = [&](const char* reason) {
    throw std::invalid_argument(fmt::format("{}[{}].to_world {}", name, number, reason));
  };
  if (!is_finite(to_world)) refuse("must be finite");
  const Placement placement = bvh::make_placement(scene.meshes[mesh].layout(), mesh, to_world, groups);
  if (!is_finite(placement.to_mesh)) refuse("must be invertible");
  const bool is_empty = bvh::is_nowhere(scene.meshes[mesh].bounds());
  if (!is_empty && !placement.is_identity() &&
      !lut::is_in_range(placement.box.lower, placement.box.upper, glm::vec3(0))) {
    refuse("must not lead beyond 1e18");
  }
  return placement;
}

void check_number(std::size_t number, std::size_t count, const char* what) {
  if (number >= count) throw std::out_of_range(fmt::format("there is no {} {} among {}", what, number, count));
}

void check_origins(const std::vector<OccluderBvh>& meshes) {
  for (std::size_t i = 1; i < meshes.size(); ++i) {
    if (meshes[i].origin() == meshes[0].origin()) continue;
    throw std::invalid_argument(fmt::format("meshes[{}] must have the origin of meshes[0]", i));
  }
}

std::shared_ptr<SceneLayout> make_layout(std::vector<OccluderBvh> meshes, std::span<const OccluderInstance> instances) {
  if (instances.size() > std::numeric_limits<std::int32_t>::max()) {
    throw std::invalid_argument(fmt::format("instances must be less than 2^31, not {}", instances.size()));
  }
  check_origins(meshes);
  auto scene = std::make_shared<SceneLayout>();
  scene->meshes = std::move(meshes);
  for (std::size_t i = 0; i < instances.size(); ++i) {
    if (instances[i].mesh < scene->meshes.size()) continue;
    throw std::invalid_argument(
        fmt::format("instances[{}].mesh is {}, and there are {} meshes", i, instances[i].mesh, scene->meshes.size()));
  }
  scene->placements.resize(instances.size());
  tbb::parallel_for(std::size_t{0}, instances.size(), [&](std::size_t i) {
    const OccluderInstance& instance = instances[i];
    scene->placements[i] = make_checked(*scene, instance.mesh, instance.to_world, instance.groups, "instances", i);
  });
  bvh::build_nodes(*scene);
  return scene;
}

// One hierarchy for each mesh that instances name by the same arrays.
class SharedMeshes {
 public:
  SharedMeshes(const BuildOptions& options, const Progress& progress) : options_(options), progress_(progress) {
    options_.keep_zero_area = true;
  }

  std::uint32_t number_of(const MeshInstance& instance) {
    auto& numbers = numbers_[{instance.positions.data(), instance.triangles.data()}];
    for (const std::uint32_t number : numbers) {
      if (sources_[number].positions == instance.positions && sources_[number].triangles == instance.triangles) {
        return number;
      }
    }
    numbers.push_back(static_cast<std::uint32_t>(meshes.size()));
    meshes.emplace_back(TriangleMesh{instance.positions, instance.triangles}, options_, progress_);
    sources_.push_back(instance);
    return numbers.back();
  }

  std::vector<OccluderBvh> meshes;

 private:
  BuildOptions options_;
  const Progress& progress_;
  std::vector<MeshInstance> sources_;  // by mesh
  std::map<std::pair<const void*, const void*>, std::vector<std::uint32_t>> numbers_;
};

}  // namespace

OccluderScene::OccluderScene(OccluderBvh mesh)
    : layout_(make_layout({std::move(mesh)}, std::vector{OccluderInstance{}})) {}

OccluderScene::OccluderScene(std::vector<OccluderBvh> meshes, std::span<const OccluderInstance> instances)
    : layout_(make_layout(std::move(meshes), instances)) {}

OccluderScene::OccluderScene(std::span<const MeshInstance> instances, const BuildOptions& options,
                             const Progress& progress) {
  SharedMeshes shared(options, progress);
  std::vector<OccluderInstance> placed;
  placed.reserve(instances.size());
  for (const MeshInstance& instance : instances) placed.push_back({shared.number_of(instance), instance.to_world});
  layout_ = make_layout(std::move(shared.meshes), placed);
}

std::size_t OccluderScene::mesh_count() const { return layout_->meshes.size(); }
std::size_t OccluderScene::instance_count() const { return layout_->placements.size(); }

const OccluderBvh& OccluderScene::mesh(std::uint32_t mesh) const {
  check_number(mesh, mesh_count(), "mesh");
  return layout_->meshes[mesh];
}

OccluderInstance OccluderScene::instance(std::uint32_t instance) const {
  check_number(instance, instance_count(), "instance");
  const Placement& placement = layout_->placements[instance];
  return {placement.mesh, placement.to_world, placement.groups};
}

const Bounds& OccluderScene::bounds() const { return layout_->bounds; }

const glm::dvec3& OccluderScene::origin() const {
  static const glm::dvec3 kZero(0);
  return layout_->meshes.empty() ? kZero : layout_->meshes[0].origin();
}

std::uint64_t OccluderScene::occluder_count() const {
  std::uint64_t count = 0;
  for (const Placement& placement : layout_->placements) {
    count += layout_->meshes[placement.mesh].report().occluder_count;
  }
  return count;
}

std::size_t OccluderScene::memory_bytes() const {
  std::size_t bytes = layout_->placements.size() * sizeof(Placement) + layout_->nodes.size() * sizeof(bvh::Node);
  for (const OccluderBvh& mesh : layout_->meshes) bytes += mesh.report().memory_bytes;
  return bytes;
}

bvh::SceneLayout& OccluderScene::own_layout() {
  if (layout_.use_count() > 1) layout_ = std::make_shared<SceneLayout>(*layout_);
  return *layout_;
}

void OccluderScene::move(std::span<const InstanceMove> moves) {
  std::vector<Placement> moved(moves.size());
  for (std::size_t i = 0; i < moves.size(); ++i) {
    if (moves[i].instance < instance_count()) continue;
    throw std::invalid_argument(
        fmt::format("moves[{}].instance is {}, and there are {} instances", i, moves[i].instance, instance_count()));
  }
  tbb::parallel_for(std::size_t{0}, moves.size(), [&](std::size_t i) {
    const Placement& old = layout_->placements[moves[i].instance];
    moved[i] = make_checked(*layout_, old.mesh, moves[i].to_world, old.groups, "moves", i);
  });
  SceneLayout& scene = own_layout();
  for (std::size_t i = 0; i < moves.size(); ++i) scene.placements[moves[i].instance] = moved[i];
  bvh::update_nodes(scene);
}

void OccluderScene::set_groups(std::uint32_t instance, std::uint32_t groups) {
  check_number(instance, instance_count(), "instance");
  own_layout().placements[instance].groups = groups;
}

void OccluderScene::set_mesh(std::uint32_t mesh, OccluderBvh occluders) {
  check_number(mesh, mesh_count(), "mesh");
  auto changed = std::make_shared<SceneLayout>(*layout_);
  const bool was_empty = bvh::is_nowhere(changed->meshes[mesh].bounds());
  changed->meshes[mesh] = std::move(occluders);
  check_origins(changed->meshes);
  std::vector<Placement>& placements = changed->placements;
  tbb::parallel_for(std::size_t{0}, placements.size(), [&](std::size_t i) {
    if (placements[i].mesh != mesh) return;
    placements[i] = make_checked(*changed, mesh, placements[i].to_world, placements[i].groups, "instances", i);
  });
  if (was_empty) {
    bvh::build_nodes(*changed);  // the nodes have no place for its instances
  } else {
    bvh::update_nodes(*changed);
  }
  layout_ = std::move(changed);
}

}  // namespace lkao
