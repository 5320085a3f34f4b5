#include "scene/obj_writer.h"

#include <cstdint>
#include <stdexcept>

#include <fmt/format.h>

#include "scene/output_buffer.h"

namespace lkao::scene {

void write_obj(std::ostream& out, const Mesh& mesh, std::span<const float> occlusion, ColourCoding coding) {
  if (occlusion.size() != mesh.positions.size()) {
    throw std::invalid_argument(fmt::format("write_obj: occlusion has {} entries, the mesh has {} vertices",
                                            occlusion.size(), mesh.positions.size()));
  }
  const bool is_local = mesh.origin != glm::dvec3(0.0);
  OutputBuffer lines(out);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3& p = mesh.positions[i];
    if (is_local) {
      const glm::dvec3 place = glm::dvec3(p) + mesh.origin;
      lines.print("v {:.17g} {:.17g} {:.17g}", place.x, place.y, place.z);
    } else {
      lines.print("v {} {} {}", p.x, p.y, p.z);
    }
    const double grey = grey_of(occlusion[i], coding);
    lines.print(" {0:.5g} {0:.5g} {0:.5g}\n", grey);
  }
  for (const glm::uvec3& t : mesh.triangles) {
    lines.print("f {} {} {}\n", std::uint64_t{t.x} + 1, std::uint64_t{t.y} + 1, std::uint64_t{t.z} + 1);
  }
}

}  // namespace lkao::scene
