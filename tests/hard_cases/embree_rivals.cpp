#include <memory>

#include "reference/embree_reference.h"
#include "rivals.h"

namespace lkao::tests {

std::vector<Rival> make_rivals(const Mesh& mesh) {
  const scene::Mesh copy{mesh.positions, mesh.triangles};
  std::vector<Rival> rivals;
  for (bool robust : {false, true}) {
    const auto embree = std::make_shared<reference::EmbreeReference>(copy, reference::ReferenceOptions{robust});
    rivals.push_back({robust ? "Embree robust" : "Embree default",
                      [embree](const AmbientOcclusion& ao, const Receiver& receiver, std::uint64_t index) {
                        return embree->query(ao, receiver, index).mask;
                      }});
  }
  return rivals;
}

}  // namespace lkao::tests
