#include "scene/formats/gltf/vertex_values.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

namespace lkao::scene::gltf {

namespace {

// Sums of a group's vertices over instances.
struct Sums {
  std::vector<double> values;
  std::vector<std::size_t> counts;

  void add(std::span<const float> more) {
    values.resize(more.size());
    counts.resize(more.size());
    for (std::size_t i = 0; i < more.size(); ++i) {
      if (std::isnan(more[i])) continue;
      values[i] += static_cast<double>(more[i]);
      ++counts[i];
    }
  }
  std::vector<float> means() const {
    std::vector<float> means(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (counts[i] > 0) means[i] = static_cast<float>(values[i] / static_cast<double>(counts[i]));
    }
    return means;
  }
};

// Of a node's blocks, the first at `begin`, those of its first instance; the others' follow in the same order.
std::size_t group_count_of(std::span<const VertexBlock> blocks, std::size_t begin) {
  std::size_t end = begin + 1;
  while (end < blocks.size() && blocks[end].node == blocks[begin].node &&
         blocks[end].instance == blocks[begin].instance) {
    ++end;
  }
  return end - begin;
}

// Bytes of all values, and accessors of them.
class ValueWriter {
 public:
  ValueWriter(Document& document, const AttributeCoding& coding) : document_(document), coding_(coding) {}

  // Where they begin among the bytes.
  std::size_t add(std::span<const float> values) {
    const std::size_t begin = bytes_.size();
    for (const float value : values) coding_.encode(value, bytes_);
    return begin;
  }

  // Once all are added.
  std::size_t add_view() {
    return document_.add_view(bytes_, fmt::format(R"(,"byteStride":{},"target":34962)", coding_.size));
  }
  std::size_t add_accessor(std::size_t view, std::size_t begin, std::size_t count) {
    return document_.add(
        "accessors", fmt::format(R"({{"bufferView":{},"byteOffset":{},"componentType":5126,"count":{},"type":"{}"}})",
                                 view, begin, count, coding_.shape));
  }

 private:
  Document& document_;
  const AttributeCoding& coding_;
  std::string bytes_;
};

// Meshes with the values that nodes show.
class MeshWriter {
 public:
  MeshWriter(Document& document, const AttributeCoding& coding)
      : document_(document), coding_(coding), values_(document, coding) {}

  void add(const ShownValues& node) {
    std::vector<Variant>& variants = variants_[node.mesh];
    const auto [begin, end] = by_hash_.equal_range(hash_of(node));
    const auto has_same = [&](const auto& known) {
      return known.second.first == node.mesh && variants[known.second.second].shown->groups == node.groups;
    };
    const auto same = std::find_if(begin, end, has_same);
    const std::size_t number = same == end ? variants.size() : same->second.second;
    if (same == end) {
      by_hash_.emplace(hash_of(node), std::pair(node.mesh, number));
      variants.push_back(make_variant(node));
    }
    variants[number].nodes.push_back(node.node);
  }

  // Once all nodes are there.
  void finish() {
    const std::size_t view = values_.add_view();
    for (auto& [mesh, variants] : variants_) {
      for (Variant& variant : variants) add_accessors(view, variant);
      const JsonText::Place place = document_.entry("meshes", mesh);
      for (std::size_t i = 1; i < variants.size(); ++i) add_copy(place, variants[i]);
      set_attributes(document_.text(), place, variants.front());
    }
  }

 private:
  // A mesh with values of its own; the first has the place of the mesh that was there.
  struct Variant {
    const ShownValues* shown;
    std::vector<std::size_t> begins;  // of each group's values
    std::vector<std::size_t> accessors = {};
    std::vector<std::size_t> nodes = {};  // that show it
  };

  // Thousands of nodes may show one mesh.
  static std::size_t hash_of(const ShownValues& node) {
    std::size_t hash = node.mesh;
    for (const ShownValues::Group& group : node.groups) {
      const std::string_view bytes(reinterpret_cast<const char*>(group.values.data()),
                                   group.values.size() * sizeof(float));
      hash = hash * 31 + std::hash<std::string_view>()(bytes);
    }
    return hash;
  }

  Variant make_variant(const ShownValues& node) {
    Variant variant{.shown = &node, .begins = {}};
    variant.begins.reserve(node.groups.size());
    for (const ShownValues::Group& group : node.groups) variant.begins.push_back(values_.add(group.values));
    return variant;
  }

  void add_accessors(std::size_t view, Variant& variant) {
    const std::vector<ShownValues::Group>& groups = variant.shown->groups;
    variant.accessors.reserve(groups.size());
    for (std::size_t g = 0; g < groups.size(); ++g) {
      variant.accessors.push_back(values_.add_accessor(view, variant.begins[g], groups[g].values.size()));
    }
  }

  void add_copy(JsonText::Place mesh, const Variant& variant) {
    JsonText copy{std::string(document_.text().text_of(mesh))};
    set_attributes(copy, copy.root(), variant);
    const std::string number = std::to_string(document_.add("meshes", copy.changed()));
    for (const std::size_t node : variant.nodes) document_.text().set(document_.entry("nodes", node), "mesh", number);
  }

  void set_attributes(JsonText& text, JsonText::Place mesh, const Variant& variant) const {
    const JsonText::Place primitives = *text.find(mesh, "primitives");
    for (std::size_t g = 0; g < variant.accessors.size(); ++g) {
      for (const std::uint32_t primitive : variant.shown->groups[g].primitives) {
        const JsonText::Place attributes = *text.find(text.element(primitives, primitive), "attributes");
        text.set(attributes, coding_.name, std::to_string(variant.accessors[g]));
      }
    }
  }

  Document& document_;
  const AttributeCoding& coding_;
  ValueWriter values_;
  std::map<std::size_t, std::vector<Variant>> variants_;                               // by mesh
  std::unordered_multimap<std::size_t, std::pair<std::size_t, std::size_t>> by_hash_;  // mesh, number in its list
};

}  // namespace

std::vector<ShownValues> values_of_nodes(std::span<const VertexBlock> blocks, std::span<const float> values) {
  std::vector<ShownValues> nodes;
  for (std::size_t begin = 0; begin < blocks.size();) {
    ShownValues shown{.node = blocks[begin].node, .mesh = blocks[begin].mesh, .groups = {}};
    const std::size_t group_count = group_count_of(blocks, begin);
    std::vector<Sums> sums(group_count);
    std::size_t i = begin;
    for (; i < blocks.size() && blocks[i].node == shown.node; ++i) {
      sums[(i - begin) % group_count].add(values.subspan(blocks[i].first_vertex, blocks[i].vertex_count));
    }
    shown.instance_count = (i - begin) / group_count;
    shown.groups.reserve(group_count);
    for (std::size_t g = 0; g < group_count; ++g) {
      shown.groups.push_back({blocks[begin + g].primitives, sums[g].means()});
    }
    nodes.push_back(std::move(shown));
    begin = i;
  }
  return nodes;
}

void add_attribute(Document& document, const std::vector<ShownValues>& shown, const AttributeCoding& coding) {
  if (shown.empty()) return;
  MeshWriter writer(document, coding);
  for (const ShownValues& node : shown) writer.add(node);
  writer.finish();
}

}  // namespace lkao::scene::gltf
