// raw_answers FILE: what C++ answers about the built-in atrium, as raw numbers for the tests of the Python package, one
// array behind the other: positions, normals, geometric normals, occlusion, bent normals (float32), masks (uint64).
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <span>
#include <vector>

#include "lkao/lkao.h"
#include "scene/camera.h"
#include "scene/load.h"

namespace {

template <typename Number>
void write(std::ofstream& file, std::span<const Number> numbers) {
  file.write(reinterpret_cast<const char*>(numbers.data()), static_cast<std::streamsize>(numbers.size_bytes()));
}

}  // namespace

// The same numbers stand in test_query.py.
int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const lkao::scene::Mesh mesh = lkao::scene::load("builtin:atrium");
  const lkao::scene::Camera camera{.eye = {0, 2, 6}, .target = {0, 2, 0}, .fov = 70};
  const std::vector<lkao::Receiver> receivers = lkao::scene::find_receivers(mesh, camera, 40, 30).receivers;
  const lkao::OccluderBvh occluders(mesh.view());
  const lkao::AmbientOcclusion ao(occluders, lkao::SamplePattern::standard(100), {.radius = 2.0f, .seed = 5});

  const std::size_t words = static_cast<std::size_t>(ao.pattern().word_count());
  std::vector<float> occlusion(receivers.size());
  std::vector<glm::vec3> bent_normals(receivers.size());
  std::vector<std::uint64_t> masks(receivers.size() * words);
  ao.query(receivers, {.occlusion = occlusion, .bent_normals = bent_normals, .mask_words = masks}, 7);

  std::ofstream file(argv[1], std::ios::binary);
  for (glm::vec3 lkao::Receiver::*member :
       {&lkao::Receiver::position, &lkao::Receiver::normal, &lkao::Receiver::geometric_normal}) {
    for (const lkao::Receiver& receiver : receivers) write<glm::vec3>(file, {&(receiver.*member), 1});
  }
  write<float>(file, occlusion);
  write<glm::vec3>(file, bent_normals);
  write<std::uint64_t>(file, masks);
  return file.good() ? 0 : 1;
}
