// Occlusion of vertices, corners and faces of a mesh.
#include <cmath>
#include <limits>
#include <memory>

#include <pybind11/stl.h>

#include "bake/corner_receivers.h"
#include "bake/face_samples.h"
#include "bake/least_squares.h"
#include "bake/split_vertices.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/long_call.h"
#include "python/meshes.h"
#include "python/words.h"
#include "scene/facet.h"

namespace lkao::python {
namespace {

using bake::Per;

constexpr Word<Per> kPers[] = {{"vertex", Per::vertex}, {"corner", Per::corner}, {"face", Per::face}};
constexpr Word<scene::NormalSource> kNormals[] = {{"facet", scene::NormalSource::facet},
                                                  {"smooth", scene::NormalSource::smooth}};

// The receivers of a mesh, and what becomes of their occlusion. Stays where it is made.
class Baking {
 public:
  Baking(const py::array& positions, const py::array& triangles, const Triple& origin, const std::string& per,
         bool least_squares, const std::string& normals, const std::optional<std::pair<Triple, Triple>>& occluders)
      : per_(value_of(kPers, per, "per")), is_fitted_(least_squares), mesh_(mesh_of(positions, triangles, origin)) {
    if (per_ == Per::face && is_fitted_) {
      throw std::invalid_argument("filter 'least_squares' is for per 'vertex' and 'corner', not for 'face'");
    }
    face_count_ = mesh_.triangles.size();
    const scene::NormalSource source = value_of(kNormals, normals, "normals");
    const py::gil_scoped_release unlocked;
    keep_usable_triangles();
    bounds_ = scene::bounds_of(mesh_);
    if (occluders) {
      bounds_ = {glm::vec3(vector_of(occluders->first)), glm::vec3(vector_of(occluders->second))};
    }
    normals_ = std::make_unique<scene::CornerNormals>(mesh_, source);
    if (per_ != Per::face) places_ = bake::make_places(*normals_, per_);
    if (per_ == Per::face || is_fitted_) {
      samples_ = bake::sample_faces(*normals_);
    } else {
      samples_.receivers = bake::corner_receivers(*normals_, bounds_);
    }
  }
  Baking(const Baking&) = delete;
  Baking& operator=(const Baking&) = delete;

  std::size_t receiver_count() const { return samples_.receivers.size(); }

  // Positions less the origin, normals, geometric normals.
  py::tuple receivers() const {
    std::vector<glm::vec3> points, normals, geometric_normals;
    points.reserve(receiver_count());
    normals.reserve(receiver_count());
    geometric_normals.reserve(receiver_count());
    for (const Receiver& receiver : samples_.receivers) {
      require(receiver.excluded_primitive == kNoPrimitive, "a receiver excludes a primitive");
      points.push_back(receiver.position);
      normals.push_back(receiver.normal);
      geometric_normals.push_back(receiver.geometric_normal);
    }
    return py::make_tuple(rows_of(std::move(points)), rows_of(std::move(normals)),
                          rows_of(std::move(geometric_normals)));
  }

  // Of every vertex, (n); every face, (m); or every corner, (m, 3). NaN where there is none.
  py::array values(const py::array& occlusion) const {
    const std::span<const float> answers = packed<float>(occlusion);
    require(answers.size() == receiver_count(), "there must be an occlusion for every receiver");
    std::vector<float> values = values_without_lock(answers);
    const auto face_count = static_cast<py::ssize_t>(face_count_);
    if (per_ == Per::corner) return array_of<float>(std::move(values), {face_count, 3});
    return row_of(std::move(values));
  }

 private:
  // As scene::drop_bad_triangles, but that it remembers which they were.
  void keep_usable_triangles() {
    kept_.reserve(mesh_.triangles.size());
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (!scene::Facet(mesh_, mesh_.triangles[t]).is_usable()) continue;
      mesh_.triangles[kept_.size()] = mesh_.triangles[t];
      kept_.push_back(t);
    }
    mesh_.triangles.resize(kept_.size());
  }

  std::vector<float> values_without_lock(std::span<const float> occlusion) const {
    const py::gil_scoped_release unlocked;
    constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
    if (per_ == Per::face) {
      const std::vector<float> of_kept = bake::average_on_faces(samples_, occlusion);
      std::vector<float> values(face_count_, kNone);
      for (std::size_t k = 0; k < kept_.size(); ++k) values[kept_[k]] = of_kept[k];
      return values;
    }
    const std::vector<float> of_places = is_fitted_ ? bake::least_squares_values(mesh_, places_, samples_, occlusion)
                                                    : bake::average_at_places(mesh_, places_, occlusion, bounds_);
    // Of per 'vertex' the corners of a vertex are one place.
    const bool is_per_vertex = per_ == Per::vertex;
    std::vector<float> values(is_per_vertex ? mesh_.positions.size() : 3 * face_count_, kNone);
    for (std::size_t k = 0; k < kept_.size(); ++k) {
      for (int corner = 0; corner < 3; ++corner) {
        const std::size_t target =
            is_per_vertex ? mesh_.triangles[k][corner] : 3 * kept_[k] + static_cast<std::size_t>(corner);
        values[target] = of_places[places_.of_corner[k][corner]];
      }
    }
    return values;
  }

  Per per_;
  bool is_fitted_;
  scene::Mesh mesh_;
  std::size_t face_count_ = 0;     // of the mesh as it came
  std::vector<std::size_t> kept_;  // its usable triangles
  Bounds bounds_{};
  std::unique_ptr<scene::CornerNormals> normals_;
  bake::Places places_;
  bake::FaceSamples samples_;
};

}  // namespace

void bind_baking(py::module_& module) {
  py::class_<Baking>(module, "Baking")
      .def(py::init<const py::array&, const py::array&, const Triple&, const std::string&, bool, const std::string&,
                    const std::optional<std::pair<Triple, Triple>>&>(),
           py::arg("positions"), py::arg("triangles"), py::arg("origin"), py::arg("per"), py::arg("least_squares"),
           py::arg("normals"), py::arg("occluders"))
      .def_property_readonly("receiver_count", &Baking::receiver_count)
      .def("receivers", &Baking::receivers)
      .def("values", &Baking::values, py::arg("occlusion"));
}

}  // namespace lkao::python
