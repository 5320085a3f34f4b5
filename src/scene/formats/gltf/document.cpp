#include "scene/formats/gltf/document.h"

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "scene/formats/gltf/buffers.h"
#include "scene/formats/gltf/images.h"
#include "scene/formats/gltf/uri.h"
#include "scene/formats/text.h"

namespace lkao::scene::gltf {

namespace {

constexpr std::size_t kAlignment = 4;  // of all that accessors and chunks hold

std::size_t aligned(std::size_t size) { return (size + kAlignment - 1) / kAlignment * kAlignment; }

}  // namespace

Document::Document(const Container& container, const Value& root, const std::string& path, const std::string& output)
    : container_(container),
      root_(root),
      path_(path),
      output_(output),
      makes_glb_(equal_but_for_case(std::filesystem::path(output).extension().string(), ".glb")),
      text_(std::string(container.json)) {
  find_own_buffer();
  if (makes_glb_ && !container.is_glb) pack_images();
}

void Document::find_own_buffer() {
  if (size_of_list(root_, "buffers") == 0) return;
  const bool has_uri = root_.at("buffers").element(0).find("uri").has_value();
  if (container_.is_glb) {
    // Chunks may be longer than the buffers in them.
    if (!has_uri && container_.binary) own_.emplace(*container_.binary);
  } else if (makes_glb_ && has_uri) {
    own_.emplace(Buffers(root_, {}, path_, 0).buffer(0));
  }
}

void Document::pack_images() {
  for (std::size_t i = 0; i < size_of_list(root_, "images"); ++i) {
    const std::optional<Value> uri = root_.at("images").element(i).find("uri");
    if (!uri) continue;
    const std::string bytes = bytes_of_uri(path_, uri->text());
    const std::string type = image_type_of(bytes);
    if (type.empty()) continue;
    rewrite("images", i, {"uri", "mimeType"},
            {fmt::format(R"("bufferView":{})", add_view(bytes)), fmt::format(R"("mimeType":"{}")", type)});
  }
}

JsonText::Place Document::entry(const char* list, std::size_t index) const {
  return text_.element(*text_.find(text_.root(), list), index);
}

void Document::rewrite(const char* list, std::size_t index, const std::set<std::string>& left_out,
                       const std::vector<std::string>& more) {
  const JsonText::Place place = entry(list, index);
  std::vector<std::string> members = text_.members_but(place, left_out);
  members.insert(members.end(), more.begin(), more.end());
  text_.replace(place, joined(members));
  rewritten_.emplace(list, index);
}

std::size_t Document::add(const char* list, std::string value) {
  std::vector<std::string>& added = added_[list];
  added.push_back(std::move(value));
  return size_of_list(root_, list) + added.size() - 1;
}

std::size_t Document::data_begin() const { return own_ ? aligned(own_->size()) : 0; }

std::size_t Document::add_view(std::string_view bytes, const std::string& more) {
  data_.resize(aligned(data_.size()));
  const std::size_t buffer = own_ ? 0 : size_of_list(root_, "buffers");
  const std::size_t view = add("bufferViews", fmt::format(R"({{"buffer":{},"byteOffset":{},"byteLength":{}{}}})",
                                                          buffer, data_begin() + data_.size(), bytes.size(), more));
  data_ += bytes;
  return view;
}

std::size_t Document::add_png(std::string_view bytes, const std::string& name, const std::string& ending) {
  const std::string common = fmt::format(R"("mimeType":"image/png","name":{})", to_json_string(name));
  if (makes_glb_) return add("images", fmt::format(R"({{"bufferView":{},{}}})", add_view(bytes), common));
  return add("images", fmt::format(R"({{"uri":{},{}}})", put_beside(ending, std::string(bytes)), common));
}

std::string Document::put_beside(const std::string& ending, std::string bytes) {
  result_.beside.push_back({std::filesystem::path(output_).stem().string() + ending, std::move(bytes)});
  return to_json_string(encode_uri(result_.beside.back().name));
}

GltfOutput Document::finish() && {
  finish_data();
  finish_own_buffer();
  finish_lists();
  name_neighbours_anew();
  result_.bytes = text_.changed();
  if (makes_glb_) {
    const std::optional<std::string_view> binary = own_ ? std::optional<std::string_view>(*own_) : container_.binary;
    result_.bytes = make_glb(result_.bytes, binary, container_.others);
  }
  return std::move(result_);
}

void Document::finish_data() {
  if (data_.empty()) return;
  if (own_) {
    own_->resize(data_begin());
    *own_ += data_;
  } else if (makes_glb_) {
    throw std::runtime_error("a GLB without a buffer of its own gets nothing more; make it a .gltf");
  } else {
    add("buffers", fmt::format(R"({{"uri":{},"byteLength":{}}})", put_beside(".occlusion.bin", data_), data_.size()));
  }
}

void Document::finish_own_buffer() {
  if (!own_) return;
  const std::string size = std::to_string(own_->size());
  if (makes_glb_ != container_.is_glb) {
    std::vector<std::string> members = {"\"byteLength\":" + size};
    if (!makes_glb_) members.push_back("\"uri\":" + put_beside(".bin", *own_));
    rewrite("buffers", 0, {"uri", "byteLength"}, members);
  } else if (!data_.empty()) {
    text_.set(entry("buffers", 0), "byteLength", size);
  }
}

void Document::finish_lists() {
  for (const auto& [name, values] : added_) {
    if (const std::optional<JsonText::Place> list = text_.find(text_.root(), name)) {
      for (const std::string& value : values) text_.append(*list, value);
    } else {
      text_.set(text_.root(), name, joined(values, '[', ']'));
    }
  }
}

// A file in another folder finds what it names where that has always been.
void Document::name_neighbours_anew() {
  namespace fs = std::filesystem;
  const auto folder_of = [](const std::string& path) { return fs::absolute(path).parent_path(); };
  std::error_code error;
  if (fs::equivalent(folder_of(path_), folder_of(output_), error)) return;
  for (const char* list : {"buffers", "images"}) {
    for (std::size_t i = 0; i < size_of_list(root_, list); ++i) {
      const std::optional<Value> uri = root_.at(list).element(i).find("uri");
      if (!uri || !is_relative_uri(uri->text()) || rewritten_.contains({list, i})) continue;
      const fs::path there = fs::absolute(resolve_uri(path_, uri->text()));
      const std::string name = fs::relative(there, folder_of(output_), error).generic_string();
      if (error || name.empty()) throw std::runtime_error(fmt::format("{} cannot be named from there", uri->place()));
      text_.set(entry(list, i), "uri", to_json_string(encode_uri(name)));
    }
  }
}

}  // namespace lkao::scene::gltf
