// The rasterised method, in an OpenGL context of its own.
#include <stdexcept>
#include <thread>

#include <pybind11/stl.h>

#include "lkao/gl.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/long_call.h"
#include "python/meshes.h"
#include "python/words.h"
#include "raster/rasterizer.h"

namespace lkao::python {
namespace {

constexpr Word<gl::Device> kDevices[] = {
    {"automatic", gl::Device::automatic}, {"hardware", gl::Device::hardware}, {"software", gl::Device::software}};

// A context belongs to the thread in which it was made.
class Rasterizer {
 public:
  explicit Rasterizer(const std::string& device) : rasterizer_(value_of(kDevices, device, "device")) {}

  std::string renderer() const { return rasterizer_.context().renderer(); }
  bool is_software() const { return rasterizer_.context().is_software(); }

  // What the camera sees; see view() in meshes.cpp.
  void set_view(const Triple& eye, const Triple& target, const Triple& up, float fov, int width, int height,
                const py::array& positions, const py::array& normals, const py::array& geometric_normals,
                const py::array& depth) {
    check_thread();
    scene::ReceiverImage image;
    image.width = width, image.height = height;
    const std::span<const float> depths = packed<float>(depth);
    image.depth.assign(depths.begin(), depths.end());
    const std::span<const glm::vec3> points = packed<glm::vec3, float>(positions);
    const std::span<const glm::vec3> shading = packed<glm::vec3, float>(normals);
    const std::span<const glm::vec3> geometric = packed<glm::vec3, float>(geometric_normals);
    const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    require(depths.size() == count && points.size() == count && shading.size() == count && geometric.size() == count,
            "a view must have an entry for every pixel");
    image.receivers.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      image.receivers.push_back({.position = points[i], .normal = shading[i], .geometric_normal = geometric[i]});
      image.receiver_count += image.sees(i) ? 1 : 0;
    }
    rasterizer_.set_view(camera_of(eye, target, up, fov), image);
  }

  void set_occluders(const py::array& positions, const py::array& triangles, const Triple& origin,
                     const PlaneMaskTable& table, bool is_double) {
    check_thread();
    const gl::MaskPassSetup setup{.precision =
                                      is_double ? gl::Precision::double_precision : gl::Precision::single_precision};
    rasterizer_.start_pass(setup, mesh_of(positions, triangles, origin), table);
    word_count_ = table.pattern().word_count();
  }

  // Occlusion, bent normals or None, masks, and the seconds of the frame; pixels row by row from the top.
  py::tuple draw(const RayOptions& options, bool with_bent_normals) {
    check_thread();
    const double seconds = rasterizer_.draw(options, {}, with_bent_normals);
    py::object bent_normals = py::none();
    if (with_bent_normals) bent_normals = rows_of(rasterizer_.read_bent_normals());
    std::vector<std::uint64_t> words = rasterizer_.pass().read_masks();
    const auto pixel_count = static_cast<py::ssize_t>(words.size()) / word_count_;
    return py::make_tuple(row_of(rasterizer_.read_occlusion()), bent_normals,
                          array_of<std::uint64_t>(std::move(words), {pixel_count, word_count_}), seconds);
  }

 private:
  void check_thread() const {
    if (std::this_thread::get_id() == thread_) return;
    throw std::runtime_error("a Rasterizer works only in the thread in which it was made");
  }

  std::thread::id thread_ = std::this_thread::get_id();
  raster::Rasterizer rasterizer_;
  int word_count_ = 1;
};

}  // namespace

void bind_gl(py::module_& module) {
  py::class_<Rasterizer>(module, "Rasterizer")
      .def(py::init<const std::string&>(), py::arg("device"))
      .def_property_readonly("renderer", &Rasterizer::renderer)
      .def_property_readonly("is_software", &Rasterizer::is_software)
      .def("set_view", &Rasterizer::set_view, py::arg("eye"), py::arg("target"), py::arg("up"), py::arg("fov"),
           py::arg("width"), py::arg("height"), py::arg("positions"), py::arg("normals"), py::arg("geometric_normals"),
           py::arg("depth"))
      .def("set_occluders", &Rasterizer::set_occluders, py::arg("positions"), py::arg("triangles"), py::arg("origin"),
           py::arg("table"), py::arg("is_double"))
      .def("draw", &Rasterizer::draw, py::arg("options"), py::arg("with_bent_normals"));
}

}  // namespace lkao::python
