#include "bvh/embree_builder.h"

#include <algorithm>
#include <new>
#include <stdexcept>

#include <fmt/format.h>

#include "bvh/triangle_clip.h"

namespace lkao::bvh {
namespace {

template <typename Tree>
Tree* create(RTCThreadLocalAllocator allocator) {
  return new (rtcThreadLocalAlloc(allocator, sizeof(Tree), alignof(Tree))) Tree;
}

void* create_node(RTCThreadLocalAllocator allocator, unsigned child_count, void*) {
  auto* node = create<BuildNode>(allocator);
  node->child_count = child_count;
  return static_cast<BuildTree*>(node);
}

BuildNode& node_of(void* tree) { return *static_cast<BuildNode*>(static_cast<BuildTree*>(tree)); }

// Called once the children are complete.
void set_children(void* tree, void** children, unsigned child_count, void*) {
  BuildNode& node = node_of(tree);
  node.size = {.node_count = 1};
  for (unsigned i = 0; i < child_count; ++i) {
    node.children[i] = static_cast<const BuildTree*>(children[i]);
    node.size += node.children[i]->size;
  }
}

void set_bounds(void* tree, const RTCBounds** bounds, unsigned child_count, void*) {
  for (unsigned i = 0; i < child_count; ++i) {
    const RTCBounds& b = *bounds[i];
    node_of(tree).bounds[i] = {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
  }
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count, void*) {
  auto* leaf = create<BuildLeaf>(allocator);
  std::uint32_t* end = leaf->primitives;
  for (std::size_t i = 0; i < count; ++i) {
    // Spatial splits may bring two pieces of one triangle together again.
    const std::uint32_t primitive = primitives[i].primID;
    if (std::find(leaf->primitives, end, primitive) == end) *end++ = primitive;
  }
  leaf->size = {.leaf_count = 1, .reference_count = static_cast<std::size_t>(end - leaf->primitives)};
  return static_cast<BuildTree*>(leaf);
}

}  // namespace

EmbreeBuilder::EmbreeBuilder() : device_(rtcNewDevice(nullptr)), bvh_(device_ ? rtcNewBVH(device_) : nullptr) {
  if (!bvh_) throw std::runtime_error("Embree gives no builder");
}

EmbreeBuilder::~EmbreeBuilder() {
  rtcReleaseBVH(bvh_);
  rtcReleaseDevice(device_);
}

const BuildTree& EmbreeBuilder::build(const TriangleMesh& mesh, BuildPrimitives primitives, bool spatial_splits) {
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  const std::size_t count = primitives.size();
  // The builder writes its split references behind the primitives.
  primitives.resize(spatial_splits ? count * 2 : count);
  arguments.buildQuality = spatial_splits ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM;
  arguments.maxBranchingFactor = kWidth;
  arguments.maxDepth = kMaxDepth;
  // Full leaves: a vector of 4 triangles costs the same, whether it holds 1 or 4.
  arguments.minLeafSize = kLeafWidth;
  arguments.maxLeafSize = kLeafWidth;
  arguments.sahBlockSize = kLeafWidth;
  arguments.bvh = bvh_;
  arguments.primitives = primitives.data();
  arguments.primitiveCount = count;
  arguments.primitiveArrayCapacity = primitives.size();
  arguments.createNode = create_node;
  arguments.setNodeChildren = set_children;
  arguments.setNodeBounds = set_bounds;
  arguments.createLeaf = create_leaf;
  arguments.splitPrimitive = spatial_splits ? split_triangle : nullptr;
  ClipMesh clip_mesh(mesh);
  arguments.userPtr = &clip_mesh;
  const void* root = rtcBuildBVH(&arguments);
  if (root == nullptr) {
    throw std::runtime_error(fmt::format("Embree could not build a hierarchy over {} triangles (error {})", count,
                                         static_cast<int>(rtcGetDeviceError(device_))));
  }
  return *static_cast<const BuildTree*>(root);
}

}  // namespace lkao::bvh
