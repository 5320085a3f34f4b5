#include "scene/obj_writer.h"

#include <iterator>
#include <stdexcept>

#include <fmt/format.h>

namespace lkao::scene {

namespace {

// Few writes for many lines.
class LineBuffer {
 public:
  explicit LineBuffer(std::ostream& out) : out_(out) {}
  ~LineBuffer() { flush(); }

  template <class... Values>
  void put(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
    if (text_.size() >= kFlushSize) flush();
  }

 private:
  static constexpr std::size_t kFlushSize = 1 << 16;

  void flush() {
    out_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
    text_.clear();
  }

  std::ostream& out_;
  fmt::memory_buffer text_;
};

}  // namespace

void write_obj(std::ostream& out, const Mesh& mesh, std::span<const float> occlusion, ColourCoding coding) {
  if (occlusion.size() != mesh.positions.size()) {
    throw std::invalid_argument(fmt::format("write_obj: occlusion has {} entries, the mesh has {} vertices",
                                            occlusion.size(), mesh.positions.size()));
  }
  const bool is_local = mesh.origin != glm::dvec3(0.0);
  LineBuffer lines(out);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3& p = mesh.positions[i];
    if (is_local) {
      const glm::dvec3 place = glm::dvec3(p) + mesh.origin;
      lines.put("v {:.17g} {:.17g} {:.17g}", place.x, place.y, place.z);
    } else {
      lines.put("v {} {} {}", p.x, p.y, p.z);
    }
    const double grey = grey_of(occlusion[i], coding);
    lines.put(" {0:.5g} {0:.5g} {0:.5g}\n", grey);
  }
  for (const glm::uvec3& t : mesh.triangles) {
    lines.put("f {} {} {}\n", std::uint64_t{t.x} + 1, std::uint64_t{t.y} + 1, std::uint64_t{t.z} + 1);
  }
}

}  // namespace lkao::scene
