#include "lod/part_decimater.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include <OpenMesh/Core/System/omstream.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/Observer.hh>

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>
#include <glm/geometric.hpp>

#include "lod/decimater_modules.h"
#include "lod/lazy_decimater.h"
#include "lod/regions.h"

namespace lkao::lod {
namespace {

using NormalFlipping = OpenMesh::Decimater::ModNormalFlippingT<HalfEdgeMesh>;

// Where more vertices than this may go, they are worked on in regions of at most half as many.
constexpr std::size_t kMostAtOnce = 16384;

// Passes on what goes, from several threads.
class Removals {
 public:
  explicit Removals(PartDecimater::OnRemoved on_removed) : on_removed_(std::move(on_removed)) {}
  void add(std::size_t count) {
    const std::lock_guard lock(mutex_);
    on_removed_(count);
  }

 private:
  PartDecimater::OnRemoved on_removed_;
  std::mutex mutex_;
};

class RemovalObserver : public OpenMesh::Decimater::Observer {
 public:
  explicit RemovalObserver(Removals& removals) : Observer(kInterval), removals_(removals) {}
  void notify(std::size_t) override { removals_.add(2 * kInterval); }  // a collapse takes two triangles

 private:
  static constexpr std::size_t kInterval = 256;
  Removals& removals_;
};

// What all regions are simplified by. Lengths in the unit of the mesh.
struct Rule {
  const NearCells& original;
  double scale;  // from the unit of the original
  glm::dvec3 origin;
  double tolerance_from_mesh;
};

// A decimater with the modules, in the order of their cost: the first that objects ends the question.
class Worker {
 public:
  Worker(HalfEdgeMesh& mesh, const Rule& rule, Removals& removals) : decimater_(mesh), observer_(removals) {
    GateModule::Handle gate;
    NormalFlipping::Handle flipping;
    BorderModule::Handle border;
    GoneModule::Handle gone;
    ReachModule::Handle reach;
    QuadricModule::Handle quadric;
    decimater_.add(gate);
    decimater_.add(flipping);
    decimater_.add(border);
    decimater_.add(gone);
    decimater_.add(reach);
    decimater_.add(quadric);
    decimater_.module(border).set_tolerance(rule.tolerance_from_mesh);
    decimater_.module(gone).set_tolerance(rule.tolerance_from_mesh);
    decimater_.module(reach).set_original(rule.original, rule.scale, rule.origin);
    decimater_.set_observer(&observer_);
    decimater_.initialize();
  }

  void decimate(std::span<const HalfEdgeMesh::VertexHandle> vertices, double most_cost) {
    decimater_.decimate(vertices, most_cost);
  }

 private:
  LazyDecimater decimater_;
  RemovalObserver observer_;
};

// OpenMesh prints where it refuses a face; we count instead.
void silence_openmesh() {
  static const bool kSilent = (omerr().disable(), true);
  static_cast<void>(kSilent);
}

}  // namespace

struct PartDecimater::Data {
  HalfEdgeMesh mesh;
  std::vector<std::uint32_t> original_vertex;  // behind each vertex of `mesh`
  glm::dvec3 origin{0};                        // of `mesh`, in the scene
  double scale = 1;                            // from the scene's unit to the mesh's
  std::size_t refused_count = 0;
  Removals removals;

  Data(const scene::Mesh& original, OnRemoved on_removed) : removals(std::move(on_removed)) {
    add_vertices(original);
    for (const glm::uvec3& triangle : original.triangles) add_triangle(triangle);
    mesh.request_vertex_status();
    mesh.request_edge_status();
    mesh.request_face_status();
    mesh.request_face_normals();
    mesh.update_face_normals();
    set_quadrics(mesh);
  }

  // OpenMesh compares squares of areas with absolute limits: the part is brought to size 1 around the origin. By a
  // power of two, so that planes stay planes.
  void add_vertices(const scene::Mesh& original) {
    const Bounds bounds = scene::bounds_of(original);
    const double size = glm::distance(glm::dvec3(bounds.lower), glm::dvec3(bounds.upper));
    scale = std::exp2(-std::ilogb(size));
    origin = bounds.lower;
    for (std::uint32_t i = 0; i < original.positions.size(); ++i) {
      const glm::dvec3 p = (glm::dvec3(original.positions[i]) - origin) * scale;
      mesh.add_vertex({p.x, p.y, p.z});
      original_vertex.push_back(i);
    }
  }

  // Faces keep the numbers of the triangles.
  void add_triangle(const glm::uvec3& triangle) {
    using Vertex = HalfEdgeMesh::VertexHandle;
    Vertex corners[3];
    for (int i = 0; i < 3; ++i) corners[i] = Vertex(static_cast<int>(triangle[i]));
    if (mesh.add_face(corners[0], corners[1], corners[2]).is_valid()) return;
    ++refused_count;
    for (int i = 0; i < 3; ++i) {
      corners[i] = mesh.add_vertex(HalfEdgeMesh::Point(mesh.point(corners[i])));
      original_vertex.push_back(triangle[i]);
    }
    mesh.add_face(corners[0], corners[1], corners[2]);
  }

  void lock(std::span<const std::uint8_t> locked) {
    for (const auto vertex : mesh.vertices()) {
      const bool is_locked = !locked.empty() && locked[original_vertex[static_cast<std::size_t>(vertex.idx())]] != 0;
      mesh.status(vertex).set_locked(is_locked || mesh.valence(vertex) > kMostNeighbours);
    }
  }

  // Those of the vertices that may go as far as is known.
  template <typename Vertices>
  VertexGroup open(const Vertices& vertices) const {
    VertexGroup group;
    for (const HalfEdgeMesh::VertexHandle vertex : vertices) {
      if (!mesh.status(vertex).locked() && !mesh.data(vertex).is_settled) group.push_back(vertex);
    }
    return group;
  }

  // While there is much to do, in rounds: each goes up to the same cost in all regions, so that collapses come nearly
  // in the order of their cost as they would without regions, and what stayed between two regions is inside of one in
  // the next round, whose regions are others. The rest at once.
  void decimate(const Rule& rule) {
    VertexGroup left = open(mesh.vertices());
    double most_cost = 0;
    while (left.size() > kMostAtOnce) {
      // At least twice as much as before: the cheapest collapse of a vertex may have been refused.
      most_cost = std::max(2 * most_cost, median_cost(left));
      decimate_regions(rule, most_cost);
      const std::size_t before = left.size();
      left = open(mesh.vertices());
      if (left.size() > before / 16 * 15) break;
    }
    join_regions(mesh);
    Worker(mesh, rule, removals).decimate(left, std::numeric_limits<double>::infinity());
  }

  double median_cost(const VertexGroup& vertices) const {
    std::vector<double> costs;
    for (const HalfEdgeMesh::VertexHandle vertex : vertices) costs.push_back(least_cost(mesh, vertex));
    const auto middle = costs.begin() + static_cast<std::ptrdiff_t>(costs.size() / 2);
    std::ranges::nth_element(costs, middle);
    return *middle;
  }

  void decimate_regions(const Rule& rule, double most_cost) {
    const std::vector<VertexGroup> groups = split_into_regions(mesh, kMostAtOnce / 2);
    std::vector<std::unique_ptr<Worker>> workers;  // made and destroyed here: the mesh counts them
    for (std::size_t i = 0; i < groups.size(); ++i) {
      workers.push_back(std::make_unique<Worker>(mesh, rule, removals));
    }
    const auto work = [&](std::size_t i) { workers[i]->decimate(open(groups[i]), most_cost); };
    // Isolated: while it waits for the others, this thread must not begin another part.
    tbb::this_task_arena::isolate(
        [&] { tbb::parallel_for(std::size_t{0}, groups.size(), work, tbb::simple_partitioner()); });
  }
};

PartDecimater::PartDecimater(const scene::Mesh& mesh, OnRemoved on_removed) {
  silence_openmesh();
  data_ = std::make_unique<Data>(mesh, std::move(on_removed));
}
PartDecimater::~PartDecimater() = default;

void PartDecimater::decimate(const NearCells& original, double distance_before, std::span<const std::uint8_t> locked) {
  const double tolerance_from_mesh = (original.distance() - distance_before) * data_->scale;
  add_samples(data_->mesh, tolerance_from_mesh);
  data_->lock(locked);
  data_->decimate({original, data_->scale, data_->origin, tolerance_from_mesh});
}

std::vector<SimplifiedTriangle> PartDecimater::triangles() const {
  std::vector<SimplifiedTriangle> triangles;
  const HalfEdgeMesh& mesh = data_->mesh;
  for (const auto face : mesh.faces()) {  // without the deleted ones
    SimplifiedTriangle triangle{.corners = {}, .origin = static_cast<std::uint32_t>(face.idx())};
    int i = 0;
    for (const auto vertex : mesh.fv_range(face)) {
      triangle.corners[i++] = data_->original_vertex[static_cast<std::size_t>(vertex.idx())];
    }
    triangles.push_back(triangle);
  }
  return triangles;
}

std::size_t PartDecimater::refused_count() const { return data_->refused_count; }

}  // namespace lkao::lod
