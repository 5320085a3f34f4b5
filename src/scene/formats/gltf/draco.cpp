#include "scene/formats/gltf/draco.h"

#include <limits>
#include <new>
#include <stdexcept>
#include <utility>

#include <draco/compression/decode.h>
#include <fmt/format.h>

#include "scene/formats/gltf/component.h"

namespace lkao::scene::gltf {

namespace {

std::unique_ptr<draco::Mesh> decode_mesh(std::string_view bytes, const std::string& place) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  try {
    draco::StatusOr<std::unique_ptr<draco::Mesh>> mesh = draco::Decoder().DecodeMeshFromBuffer(&buffer);
    if (mesh.ok()) return std::move(mesh).value();
  } catch (const std::bad_alloc&) {
    // Damaged counts ask for senseless amounts.
  } catch (const std::length_error&) {
  }
  throw std::runtime_error(fmt::format("{}: Draco cannot read its {} bytes", place, bytes.size()));
}

ComponentType component_type(draco::DataType type, const std::string& place) {
  switch (type) {
    case draco::DT_INT8:
      return ComponentType::int8;
    case draco::DT_UINT8:
      return ComponentType::uint8;
    case draco::DT_INT16:
      return ComponentType::int16;
    case draco::DT_UINT16:
      return ComponentType::uint16;
    case draco::DT_UINT32:
      return ComponentType::uint32;
    case draco::DT_FLOAT32:
      return ComponentType::float32;
    default:
      throw std::runtime_error(
          fmt::format("{}: Draco's data type {} is none of glTF's", place, static_cast<int>(type)));
  }
}

}  // namespace

DracoMesh::DracoMesh(std::string_view bytes, std::string place)
    : place_(std::move(place)), mesh_(decode_mesh(bytes, place_)) {}
DracoMesh::~DracoMesh() = default;
DracoMesh::DracoMesh(DracoMesh&&) noexcept = default;
DracoMesh& DracoMesh::operator=(DracoMesh&&) noexcept = default;

std::size_t DracoMesh::vertex_count() const { return mesh_->num_points(); }

std::vector<std::uint32_t> DracoMesh::indices() const {
  std::vector<std::uint32_t> indices;
  indices.reserve(3 * std::size_t{mesh_->num_faces()});
  for (draco::FaceIndex f(0); f < mesh_->num_faces(); ++f) {
    for (const draco::PointIndex& point : mesh_->face(f)) indices.push_back(point.value());
  }
  return indices;
}

void DracoMesh::read(std::size_t attribute, std::size_t width, bool is_normalized, double* out) const {
  const draco::PointAttribute* values = attribute <= std::numeric_limits<std::uint32_t>::max()
                                            ? mesh_->GetAttributeByUniqueId(static_cast<std::uint32_t>(attribute))
                                            : nullptr;
  if (values == nullptr || values->num_components() != static_cast<int>(width)) {
    throw std::runtime_error(fmt::format("{}: Draco has no attribute {} of {} components", place_, attribute, width));
  }
  if (!values->is_mapping_identity() && values->indices_map_size() < vertex_count()) {
    throw std::runtime_error(fmt::format("{}: Draco's attribute {} is not there for all vertices", place_, attribute));
  }
  const ComponentType type = component_type(values->data_type(), place_);
  const std::size_t byte_count = values->buffer()->data_size();
  const std::size_t size = width * size_of(type);
  for (draco::PointIndex point(0); point < mesh_->num_points(); ++point) {
    const std::int64_t at = values->GetBytePos(values->mapped_index(point));
    if (at < 0 || static_cast<std::size_t>(at) + size > byte_count) {
      throw std::runtime_error(
          fmt::format("{}: Draco names a value of attribute {} that is not there", place_, attribute));
    }
    const auto* const bytes = reinterpret_cast<const char*>(values->buffer()->data()) + at;
    decode({bytes, size, 1, width}, type, is_normalized, out);
    out += width;
  }
}

}  // namespace lkao::scene::gltf
