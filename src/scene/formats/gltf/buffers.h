// The bytes that a glTF's accessors read.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "scene/formats/file_bytes.h"
#include "scene/formats/gltf/value.h"

namespace lkao::scene::gltf {

struct BufferView {
  std::string place;  // for errors: "bufferViews[2]"
  std::string_view bytes;
  std::size_t stride = 0;  // from one element to the next; 0: no gaps
};

// Reads a buffer when it is first asked for: those that hold nothing but images need not exist. Views are valid as long
// as the object. Throws std::runtime_error with the fault.
class Buffers {
 public:
  // The document, GLB's own buffer and the file at `path`, of file_size bytes, whose neighbours hold other buffers.
  Buffers(Value root, std::optional<std::string_view> binary, std::string path, std::size_t file_size);

  // Decompressed where need be.
  BufferView view(const Value& index);

  // All of a buffer, by its number; it is known to be there.
  std::string_view buffer(std::size_t number);

  // How many bytes were read so far, the file itself among them.
  std::size_t byte_count() const { return byte_count_; }

 private:
  std::string_view content_of(const Value& buffer, std::size_t number);
  std::string_view slice(const Value& place);

  Value root_;
  std::optional<std::string_view> binary_;
  std::string path_;
  std::size_t byte_count_;
  std::map<std::string, FileBytes> files_;           // by path
  std::map<std::size_t, std::string> data_;          // of data: URIs, by buffer
  std::map<std::size_t, std::string> decompressed_;  // by buffer view
};

}  // namespace lkao::scene::gltf
