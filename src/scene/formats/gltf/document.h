// A glTF that is written again, with more in it: as the kind of file that it is, or the other. What becomes a GLB takes
// its first buffer and its images in, as far as they are PNG and JPEG; other buffers stay files.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/formats/gltf/container.h"
#include "scene/formats/gltf/json_text.h"
#include "scene/formats/gltf/value.h"
#include "scene/gltf_writer.h"

namespace lkao::scene::gltf {

class Document {
 public:
  // The file at `path`, taken apart, which is to be written to `output`. Container and root must outlive the object.
  // Throws std::runtime_error where the first buffer of what becomes a GLB cannot be read.
  Document(const Container& container, const Value& root, const std::string& path, const std::string& output);

  const Value& root() const { return root_; }
  // The JSON, in which anything may be changed but the document's own lists.
  JsonText& text() { return text_; }
  const JsonText& text() const { return text_; }
  // An entry of one of the document's lists, which is there.
  JsonText::Place entry(const char* list, std::size_t index) const;

  // Adds an entry to one of the document's lists; returns its number.
  std::size_t add(const char* list, std::string value);
  // Adds bytes, and a view of them; returns its number. `more`: members of the view, each with a comma in front.
  std::size_t add_view(std::string_view bytes, const std::string& more = {});
  // Adds an image, in a file of that ending where files lie beside; returns its number.
  std::size_t add_png(std::string_view bytes, const std::string& name, const std::string& ending);

  // The whole. Throws std::runtime_error with the fault where that cannot be done.
  GltfOutput finish() &&;

 private:
  std::size_t data_begin() const;
  void find_own_buffer();
  void pack_images();
  void finish_data();
  void finish_own_buffer();
  void finish_lists();
  void name_neighbours_anew();
  // Adds a file beside; returns its URI in quotation marks.
  std::string put_beside(const std::string& ending, std::string bytes);
  // An entry without some of its members, and with others.
  void rewrite(const char* list, std::size_t index, const std::set<std::string>& left_out,
               const std::vector<std::string>& more);

  const Container& container_;
  Value root_;
  std::string path_, output_;
  bool makes_glb_;
  JsonText text_;
  std::map<std::string, std::vector<std::string>> added_;  // by list
  // The first buffer, where it is GLB's own, or becomes or was that.
  std::optional<std::string> own_;
  std::string data_;                                         // what is added: behind that, or a buffer of its own
  std::set<std::pair<std::string, std::size_t>> rewritten_;  // entries of lists
  GltfOutput result_;
};

}  // namespace lkao::scene::gltf
