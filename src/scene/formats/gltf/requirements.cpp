#include "scene/formats/gltf/requirements.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "scene/formats/text.h"

namespace lkao::scene::gltf {

namespace {

// Extensions that change geometry, and are obeyed.
constexpr std::string_view kObeyed[] = {"KHR_mesh_quantization",   "KHR_draco_mesh_compression",
                                        "EXT_meshopt_compression", "KHR_meshopt_compression",
                                        "EXT_mesh_gpu_instancing", "KHR_node_visibility"};

// Extensions that cannot change where triangles are at rest: looks, lights, motion and annotations.
constexpr std::string_view kHarmless[] = {"KHR_texture_transform",
                                          "KHR_texture_basisu",
                                          "EXT_texture_webp",
                                          "EXT_texture_avif",
                                          "MSFT_texture_dds",
                                          "KHR_lights_punctual",
                                          "EXT_lights_image_based",
                                          "EXT_lights_ies",
                                          "KHR_animation_pointer",
                                          "KHR_xmp",
                                          "KHR_xmp_json_ld",
                                          "KHR_node_hoverability",
                                          "KHR_node_selectability",
                                          "KHR_interactivity",
                                          "KHR_techniques_webgl",
                                          "EXT_mesh_features",
                                          "EXT_instance_features",
                                          "EXT_structural_metadata",
                                          "CESIUM_primitive_outline",
                                          "MSFT_packing_normalRoughnessMetallic",
                                          "MSFT_packing_occlusionRoughnessMetallic"};
constexpr std::string_view kMaterials = "KHR_materials_";

bool is_known(std::string_view extension) {
  const auto has = [&](const auto& list) {
    return std::find(std::begin(list), std::end(list), extension) != std::end(list);
  };
  return has(kObeyed) || has(kHarmless) || extension.starts_with(kMaterials);
}

// "2" of "2.0".
std::string_view major_of(std::string_view version) { return version.substr(0, version.find('.')); }

}  // namespace

void check_requirements(const Value& root) {
  const Value asset = root.at("asset");
  const std::string& version = asset.at("version").text();
  if (major_of(version) != "2")
    throw std::runtime_error(fmt::format("glTF {} is not supported, only 2.0", in_quotes(version)));
  if (const std::optional<Value> needed = asset.find("minVersion"); needed && needed->text() != "2.0") {
    throw std::runtime_error(fmt::format("it needs glTF {}, but only 2.0 is supported", in_quotes(needed->text())));
  }
  const std::optional<Value> required = root.find("extensionsRequired");
  if (!required) return;
  for (std::size_t i = 0; i < required->size(); ++i) {
    const Value extension = required->element(i);
    if (!is_known(extension.text())) {
      throw std::runtime_error(
          fmt::format("it needs the extension {}, which is not supported", in_quotes(extension.text())));
    }
  }
}

}  // namespace lkao::scene::gltf
