#include "bvh/build.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <glm/common.hpp>

#include "bvh/leaf.h"
#include "bvh/triangle_clip.h"
#include "bvh/zero_area.h"
#include "lkao/ambient_occlusion.h"

namespace lkao::bvh {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// What the builder makes, in its own allocator: thrown away once the layout is filled.
struct BuildNode {
  bool is_leaf;
  std::uint32_t count;  // of children or triangles
  void* children[kWidth];
  Bounds bounds[kWidth];  // of the children
  std::uint32_t primitives[kLeafWidth];
};

void* create_node(RTCThreadLocalAllocator allocator, unsigned child_count, void*) {
  auto* node = static_cast<BuildNode*>(rtcThreadLocalAlloc(allocator, sizeof(BuildNode), alignof(BuildNode)));
  node->is_leaf = false;
  node->count = child_count;
  return node;
}

void set_children(void* node, void** children, unsigned child_count, void*) {
  std::copy_n(children, child_count, static_cast<BuildNode*>(node)->children);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned child_count, void*) {
  for (unsigned i = 0; i < child_count; ++i) {
    const RTCBounds& b = *bounds[i];
    static_cast<BuildNode*>(node)->bounds[i] = {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
  }
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count, void*) {
  auto* leaf = static_cast<BuildNode*>(rtcThreadLocalAlloc(allocator, sizeof(BuildNode), alignof(BuildNode)));
  leaf->is_leaf = true;
  leaf->count = 0;
  for (std::size_t i = 0; i < count; ++i) {
    // Spatial splits may bring two pieces of one triangle together again.
    const std::uint32_t primitive = primitives[i].primID;
    std::uint32_t* end = leaf->primitives + leaf->count;
    if (std::find(leaf->primitives, end, primitive) == end) leaf->primitives[leaf->count++] = primitive;
  }
  return leaf;
}

Bounds to_bounds(const RTCBuildPrimitive& p) {
  return {{p.lower_x, p.lower_y, p.lower_z}, {p.upper_x, p.upper_y, p.upper_z}};
}

void store(RTCBounds& target, const Bounds& bounds) {
  target.lower_x = bounds.lower.x, target.lower_y = bounds.lower.y, target.lower_z = bounds.lower.z;
  target.upper_x = bounds.upper.x, target.upper_y = bounds.upper.y, target.upper_z = bounds.upper.z;
}

void split_primitive(const RTCBuildPrimitive* primitive, unsigned axis, float position, RTCBounds* left,
                     RTCBounds* right, void* user) {
  const auto& mesh = *static_cast<const TriangleMesh*>(user);
  const glm::uvec3& t = mesh.triangles[primitive->primID];
  const glm::vec3 corners[3] = {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
  const SplitBounds split = clip_triangle(corners, to_bounds(*primitive), static_cast<int>(axis), position);
  store(*left, split.left);
  store(*right, split.right);
}

// Sorts the triangles of the mesh into those the builder gets and those that are dropped and counted.
std::vector<RTCBuildPrimitive> collect_occluders(const TriangleMesh& mesh, Layout& layout) {
  std::vector<RTCBuildPrimitive> primitives;
  primitives.reserve(mesh.triangles.size() * 2);  // room for spatial splits
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    for (int k = 0; k < 3; ++k) {
      if (t[k] >= mesh.positions.size()) {
        throw std::invalid_argument(
            fmt::format("triangle {} has index {}, but there are {} positions", i, t[k], mesh.positions.size()));
      }
    }
    const glm::vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
    if (!is_in_range(a, b, c)) {
      ++layout.report.non_finite_count;
    } else if (has_zero_area(a, b, c)) {
      ++layout.report.zero_area_count;
    } else {
      const glm::vec3 lower = glm::min(a, glm::min(b, c)), upper = glm::max(a, glm::max(b, c));
      primitives.push_back({lower.x, lower.y, lower.z, 0, upper.x, upper.y, upper.z, static_cast<unsigned>(i)});
      layout.bounds = {glm::min(layout.bounds.lower, lower), glm::max(layout.bounds.upper, upper)};
    }
  }
  layout.report.triangle_count = mesh.triangles.size();
  layout.report.occluder_count = primitives.size();
  return primitives;
}

// Owns Embree's device and builder; what the builder makes lives as long as this.
class Builder {
 public:
  Builder() : device_(rtcNewDevice(nullptr)), bvh_(device_ ? rtcNewBVH(device_) : nullptr) {
    if (!bvh_) throw std::runtime_error("Embree gives no builder");
  }
  ~Builder() {
    rtcReleaseBVH(bvh_);
    rtcReleaseDevice(device_);
  }
  Builder(const Builder&) = delete;
  Builder& operator=(const Builder&) = delete;

  const BuildNode& build(const TriangleMesh& mesh, const BuildOptions& options,
                         std::vector<RTCBuildPrimitive>& primitives) {
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    const std::size_t count = primitives.size();
    // The builder writes its split references behind the primitives.
    primitives.resize(options.spatial_splits ? count * 2 : count);
    arguments.buildQuality = options.spatial_splits ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM;
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
    arguments.splitPrimitive = options.spatial_splits ? split_primitive : nullptr;
    arguments.userPtr = const_cast<TriangleMesh*>(&mesh);
    const auto* root = static_cast<const BuildNode*>(rtcBuildBVH(&arguments));
    if (!root) {
      throw std::runtime_error(fmt::format("Embree could not build a hierarchy over {} triangles (error {})", count,
                                           static_cast<int>(rtcGetDeviceError(device_))));
    }
    return *root;
  }

 private:
  RTCDevice device_;
  RTCBVH bvh_;
};

// Fills the layout depth first, children behind their parent.
class Flattener {
 public:
  explicit Flattener(Layout& layout) : layout_(layout) {}

  void flatten(const BuildNode& root) {
    add_root(root);
    fill_leaves();
  }

 private:
  // The root is a node even over a single leaf.
  void add_root(const BuildNode& root) {
    if (!root.is_leaf) {
      add_node(root);
      return;
    }
    layout_.nodes.push_back(Node::empty());
    set_child(0, 0, layout_.bounds, add_leaf(root));
  }

  void fill_leaves() {
    layout_.leaves.resize(leaves_.size());
    tbb::parallel_for(std::size_t{0}, leaves_.size(), [&](std::size_t i) {
      layout_.leaves[i] = make_leaf(layout_, {leaves_[i]->primitives, leaves_[i]->count});
    });
  }

  ChildRef add(const BuildNode& source) { return source.is_leaf ? add_leaf(source) : ChildRef::node(add_node(source)); }

  std::uint32_t add_node(const BuildNode& source) {
    const auto index = static_cast<std::uint32_t>(layout_.nodes.size());
    layout_.nodes.push_back(Node::empty());
    for (std::uint32_t i = 0; i < source.count; ++i) {
      const ChildRef child = add(*static_cast<const BuildNode*>(source.children[i]));
      set_child(index, i, source.bounds[i], child);
    }
    return index;
  }

  ChildRef add_leaf(const BuildNode& source) {
    layout_.report.reference_count += source.count;
    leaves_.push_back(&source);
    return ChildRef::leaf(static_cast<std::uint32_t>(leaves_.size() - 1));
  }

  // Faces move out: see Node.
  void set_child(std::uint32_t node, std::uint32_t child, const Bounds& bounds, ChildRef ref) {
    constexpr float kTiny = Node::kMargin;
    Bounds box;
    for (int axis = 0; axis < 3; ++axis) {
      const float lower = bounds.lower[axis], upper = bounds.upper[axis];
      box.lower[axis] = std::min(std::nextafter(lower, -kInfinity), lower - kTiny);
      box.upper[axis] = std::max(std::nextafter(upper, kInfinity), upper + kTiny);
    }
    layout_.nodes[node].set_child(static_cast<int>(child), box, ref);
  }

  Layout& layout_;
  std::vector<const BuildNode*> leaves_;  // as layout_.leaves will be
};

template <typename Vector>
std::size_t size_in_bytes(const Vector& values) {
  return values.size() * sizeof(values[0]);
}

}  // namespace

std::shared_ptr<const Layout> build(const TriangleMesh& mesh, const BuildOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  auto layout = std::make_shared<Layout>();
  layout->bounds = {glm::vec3(kInfinity), glm::vec3(-kInfinity)};
  std::vector<RTCBuildPrimitive> primitives = collect_occluders(mesh, *layout);
  if (!primitives.empty()) {
    Builder builder;
    layout->positions.assign(mesh.positions.begin(), mesh.positions.end());
    layout->triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
    Flattener(*layout).flatten(builder.build(mesh, options, primitives));
  }
  layout->nodes.shrink_to_fit();
  layout->report.node_count = layout->nodes.size();
  layout->report.memory_bytes = size_in_bytes(layout->nodes) + size_in_bytes(layout->leaves) +
                                size_in_bytes(layout->positions) + size_in_bytes(layout->triangles);
  layout->report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return layout;
}

}  // namespace lkao::bvh

namespace lkao {

OccluderBvh::OccluderBvh(const TriangleMesh& mesh, const BuildOptions& options) : layout_(bvh::build(mesh, options)) {}

const BuildReport& OccluderBvh::report() const { return layout_->report; }
const Bounds& OccluderBvh::bounds() const { return layout_->bounds; }

}  // namespace lkao
