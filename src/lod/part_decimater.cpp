#include "lod/part_decimater.h"

#include <cmath>

#include <OpenMesh/Core/System/omstream.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/Observer.hh>

#include <glm/geometric.hpp>

#include "lod/decimater_modules.h"

namespace lkao::lod {
namespace {

using Decimater = OpenMesh::Decimater::DecimaterT<HalfEdgeMesh>;
using NormalFlipping = OpenMesh::Decimater::ModNormalFlippingT<HalfEdgeMesh>;

class RemovalObserver : public OpenMesh::Decimater::Observer {
 public:
  explicit RemovalObserver(PartDecimater::OnRemoved on_removed) : Observer(kInterval), on_removed_(on_removed) {}
  void notify(std::size_t) override { on_removed_(2 * kInterval); }  // a collapse takes two triangles

 private:
  static constexpr std::size_t kInterval = 1024;
  PartDecimater::OnRemoved on_removed_;
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
  RemovalObserver observer;
  std::unique_ptr<Decimater> decimater;  // goes before the mesh
  BorderModule::Handle border;
  GoneModule::Handle gone;
  ReachModule::Handle reach;

  Data(const scene::Mesh& original, const Surface& surface, OnRemoved on_removed) : observer(std::move(on_removed)) {
    add_vertices(original);
    for (const glm::uvec3& triangle : original.triangles) add_triangle(triangle);
    add_modules(surface);
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

  // In the order of their cost; the first that objects ends the question.
  void add_modules(const Surface& surface) {
    mesh.request_face_normals();
    mesh.update_face_normals();
    decimater = std::make_unique<Decimater>(mesh);
    GateModule::Handle gate;
    NormalFlipping::Handle flipping;
    QuadricModule::Handle quadric;
    decimater->add(gate);
    decimater->add(flipping);
    decimater->add(border);
    decimater->add(gone);
    decimater->add(reach);
    decimater->add(quadric);
    decimater->module(gate).set_quadric(decimater->module(quadric));
    decimater->module(reach).set_original([this, &surface](const glm::dvec3& p, double distance) {
      return surface.is_within(p / scale + origin, distance / scale);
    });
    decimater->set_observer(&observer);
    decimater->initialize();
  }

  void set_tolerance(double tolerance, double tolerance_from_mesh) {
    decimater->module(border).set_tolerance(tolerance_from_mesh);
    decimater->module(gone).set_tolerance(tolerance_from_mesh);
    decimater->module(reach).set_tolerance(tolerance);
    decimater->module(gone).add_samples();
  }
};

PartDecimater::PartDecimater(const scene::Mesh& mesh, const Surface& surface, OnRemoved on_removed) {
  silence_openmesh();
  data_ = std::make_unique<Data>(mesh, surface, std::move(on_removed));
}
PartDecimater::~PartDecimater() = default;

void PartDecimater::decimate(double tolerance, double distance_before, std::span<const std::uint8_t> locked) {
  data_->set_tolerance(tolerance * data_->scale, (tolerance - distance_before) * data_->scale);
  for (const auto vertex : data_->mesh.vertices()) {
    const std::uint32_t original = data_->original_vertex[static_cast<std::size_t>(vertex.idx())];
    const bool is_locked = !locked.empty() && locked[original] != 0;
    data_->mesh.status(vertex).set_locked(is_locked || data_->mesh.valence(vertex) > kMostNeighbours);
  }
  data_->decimater->decimate();
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
