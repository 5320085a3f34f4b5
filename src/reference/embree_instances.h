// A scene of instances inside Embree: the rival and the oracle of OccluderScene.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lkao/occluder_scene.h"
#include "scene/camera.h"
#include "scene/embree.h"
#include "scene/mesh.h"

namespace lkao::reference {

// Embree takes rays to the space of a mesh, in single precision; OccluderScene decides in the world.
class EmbreeInstances {
 public:
  // Builds in high quality, in parallel; the meshes may go afterwards. `device_config` as of rtcNewDevice. Throws
  // std::runtime_error where Embree fails.
  EmbreeInstances(std::span<const scene::Mesh> meshes, std::span<const OccluderInstance> instances, bool robust,
                  const char* device_config = nullptr);

  RTCScene scene() const { return scene_.get(); }

  // Instances in new places, as OccluderScene::move: their geometries are committed, and the scene over all of them is
  // built again.
  void move(std::span<const InstanceMove> moves);

  // What a camera sees of the same meshes and instances, with the triangles' own normals, in parallel.
  scene::ReceiverImage see(std::span<const scene::Mesh> meshes, std::span<const OccluderInstance> instances,
                           const scene::Camera& camera, int width, int height) const;

 private:
  scene::embree::Device device_;
  std::vector<scene::embree::Scene> meshes_;
  std::vector<RTCGeometry> instances_;  // kept by the scene
  scene::embree::Scene scene_;
};

}  // namespace lkao::reference
