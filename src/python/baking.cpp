// Occlusion of vertices, corners and faces of a mesh.
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include <pybind11/stl.h>

#include "bake/corner_receivers.h"
#include "bake/face_samples.h"
#include "bake/least_squares.h"
#include "bake/split_vertices.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/long_call.h"
#include "python/surfaces.h"
#include "python/words.h"

namespace lkao::python {
namespace {

using bake::Per;

constexpr Word<Per> kPers[] = {{"vertex", Per::vertex}, {"corner", Per::corner}, {"face", Per::face}};

// The receivers of a mesh, and what becomes of their occlusion.
class Baking {
 public:
  Baking(std::shared_ptr<const Surface> surface, const std::string& per, bool least_squares,
         const std::optional<std::pair<Triple, Triple>>& occluders)
      : surface_(std::move(surface)), per_(value_of(kPers, per, "per")), is_fitted_(least_squares) {
    if (per_ == Per::face && is_fitted_) {
      throw std::invalid_argument("filter 'least_squares' is for per 'vertex' and 'corner', not for 'face'");
    }
    const py::gil_scoped_release unlocked;
    bounds_ = scene::bounds_of(mesh());
    if (occluders) {
      bounds_ = {glm::vec3(vector_of(occluders->first)), glm::vec3(vector_of(occluders->second))};
    }
    if (per_ != Per::face) places_ = bake::make_places(surface_->normals(), per_);
    if (per_ == Per::face || is_fitted_) {
      samples_ = bake::sample_faces(surface_->normals());
    } else {
      samples_.receivers = bake::corner_receivers(surface_->normals(), bounds_);
    }
  }

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
    const auto face_count = static_cast<py::ssize_t>(surface_->triangle_count());
    if (per_ == Per::corner) return array_of<float>(std::move(values), {face_count, 3});
    return row_of(std::move(values));
  }

 private:
  const scene::Mesh& mesh() const { return surface_->mesh(); }

  std::vector<float> values_without_lock(std::span<const float> occlusion) const {
    const py::gil_scoped_release unlocked;
    const std::vector<std::size_t>& kept = surface_->kept();
    constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
    if (per_ == Per::face) {
      const std::vector<float> of_kept = bake::average_on_faces(samples_, occlusion);
      std::vector<float> values(surface_->triangle_count(), kNone);
      for (std::size_t k = 0; k < kept.size(); ++k) values[kept[k]] = of_kept[k];
      return values;
    }
    const std::vector<float> of_places = is_fitted_ ? bake::least_squares_values(mesh(), places_, samples_, occlusion)
                                                    : bake::average_at_places(mesh(), places_, occlusion, bounds_);
    // Of per 'vertex' the corners of a vertex are one place.
    const bool is_per_vertex = per_ == Per::vertex;
    std::vector<float> values(is_per_vertex ? mesh().positions.size() : 3 * surface_->triangle_count(), kNone);
    for (std::size_t k = 0; k < kept.size(); ++k) {
      for (int corner = 0; corner < 3; ++corner) {
        const std::size_t target =
            is_per_vertex ? mesh().triangles[k][corner] : 3 * kept[k] + static_cast<std::size_t>(corner);
        values[target] = of_places[places_.of_corner[k][corner]];
      }
    }
    return values;
  }

  std::shared_ptr<const Surface> surface_;
  Per per_;
  bool is_fitted_;
  Bounds bounds_{};
  bake::Places places_;
  bake::FaceSamples samples_;
};

}  // namespace

void bind_baking(py::module_& module) {
  py::class_<Baking>(module, "Baking")
      .def(py::init<std::shared_ptr<Surface>, const std::string&, bool,
                    const std::optional<std::pair<Triple, Triple>>&>(),
           py::arg("surface"), py::arg("per"), py::arg("least_squares"), py::arg("occluders"))
      .def_property_readonly("receiver_count", &Baking::receiver_count)
      .def("receivers", &Baking::receivers)
      .def("values", &Baking::values, py::arg("occlusion"));
}

}  // namespace lkao::python
