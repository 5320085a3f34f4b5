// Materials with holes by transparency (alphaMode), and where their images lie on triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "scene/formats/alpha_images.h"
#include "scene/formats/gltf/buffers.h"
#include "scene/formats/gltf/primitive.h"
#include "scene/formats/gltf/value.h"
#include "scene/holes.h"

namespace lkao::scene::gltf {

// Of a material, for messages: its place in the document where it has none.
std::string name_of(const Value& material);

// What a material's alpha means: nothing, that something is there or not, or how much of it.
enum class AlphaMode { opaque, mask, blend };

// Of materials that have one; opaque where it has none.
AlphaMode alpha_mode_of(const Value& material);

class HoleReader {
 public:
  // The document, its buffers, and the file at `path`, beside which other images are. `decode` empty: everything is
  // whole. All must outlive it.
  HoleReader(Value root, Buffers& buffers, std::string path, const DecodeAlpha& decode);

  bool is_reading() const { return read_images_.is_reading(); }

  // Of the triangles of a primitive, with kWhole as their material where alpha is so much on all of them that nothing
  // is missing; empty where all are whole. Throws std::runtime_error with the fault where the document is wrong. An
  // image that cannot be read is a remark.
  std::vector<HoleTriangle> read(const Primitive& primitive, const std::vector<glm::uvec3>& triangles);

  // Those that triangles name.
  std::vector<HoleMaterial> take_materials() { return std::move(materials_); }
  // A line each, of images that could not be read; of many, one line.
  std::vector<std::string> remarks() const { return read_images_.remarks(); }

 private:
  // A material as triangles use it.
  struct Look {
    std::uint32_t number;  // in materials_
    std::optional<Value> texture;
  };

  const Look& look_of(const Value& material, std::size_t number);
  std::optional<AlphaTexture> open_texture(const Value& info, const std::string& material);
  std::shared_ptr<const AlphaImage> image_of(const Value& texture, const std::string& material);
  std::shared_ptr<const AlphaImage> decode(const Value& image, const std::string& material);
  std::string bytes_of(const Value& image, const std::string& name);

  Value root_;
  Buffers& buffers_;
  std::string path_;
  AlphaImages read_images_;
  std::vector<HoleMaterial> materials_;
  std::map<std::size_t, Look> looks_;                                // by material
  std::map<std::size_t, std::shared_ptr<const AlphaImage>> images_;  // by number; null: cannot be read
};

}  // namespace lkao::scene::gltf
