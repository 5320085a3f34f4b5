#include "lod/chain_file.h"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "scene/mesh_file.h"
#include "scene/ply_writer.h"

namespace lkao::lod {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "lkao levels of detail";
constexpr int kVersion = 1;
constexpr const char* kEnding = ".json";

std::string document_of(const Chain& chain, std::span<const std::string> files) {
  Json levels = Json::array();
  for (std::size_t i = 0; i < chain.levels.size(); ++i) {
    const Level& level = chain.levels[i];
    Json entry = {{"mesh", fs::path(files[i + 1]).filename().string()},
                  {"vertices", level.mesh.positions.size()},
                  {"triangles", level.mesh.triangles.size()},
                  {"epsilon", level.epsilon},
                  {"r_min", level.r_min}};
    entry["r_max"] = std::isfinite(level.r_max) ? Json(level.r_max) : Json(nullptr);  // JSON has no infinity
    levels.push_back(std::move(entry));
  }
  const Json document = {
      {"format", kFormat}, {"version", kVersion}, {"k", chain.k}, {"growth", chain.growth}, {"levels", levels}};
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

template <typename Write>
void write_file(const std::string& name, const std::string& target, Write write) {
  std::ofstream file(target, std::ios::binary);
  write(file);
  file.close();
  if (!file) throw std::runtime_error(fmt::format("cannot write '{}'", name));
}

// Reads one document. Everything thrown lacks the file's name; load_chain adds it.
class Reader {
 public:
  explicit Reader(const std::string& path) : folder_(fs::path(path).parent_path()) {
    std::error_code error;
    if (!fs::exists(path, error)) throw std::runtime_error("no such file");
    if (fs::is_directory(path, error)) throw std::runtime_error("is a directory, not a chain");
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error("cannot be opened for reading");
    try {
      document_ = Json::parse(file);
    } catch (const Json::parse_error& fault) {
      throw std::runtime_error(fmt::format("not a JSON document: broken at byte {}", fault.byte));
    }
  }

  Chain read(std::optional<glm::dvec3> origin) const {
    if (!document_.is_object() || !document_.contains("format") || document_["format"] != kFormat) {
      throw std::runtime_error(fmt::format("format: expected \"{}\"", kFormat));
    }
    if (!document_.contains("version") || document_["version"] != kVersion) {
      throw std::runtime_error(fmt::format("version: expected {}", kVersion));
    }
    Chain chain{.k = number(document_, "", "k"), .growth = number(document_, "", "growth"), .levels = {}};
    if (!document_.contains("levels") || !document_["levels"].is_array() || document_["levels"].empty()) {
      throw std::runtime_error("levels: expected an array with at least one level");
    }
    for (std::size_t i = 0; i < document_["levels"].size(); ++i) {
      chain.levels.push_back(read_level(document_["levels"][i], fmt::format("levels[{}].", i)));
    }
    check(chain);
    for (std::size_t i = 0; i < chain.levels.size(); ++i) {
      read_mesh(i, origin, chain.levels[i].mesh);
      origin = chain.levels[i].mesh.origin;
    }
    return chain;
  }

 private:
  static float number(const Json& object, const std::string& place, const char* key) {
    if (!object.contains(key) || !object[key].is_number()) {
      throw std::runtime_error(fmt::format("{}{}: expected a number", place, key));
    }
    return object[key].get<float>();
  }

  static Level read_level(const Json& entry, const std::string& place) {
    if (!entry.is_object()) throw std::runtime_error(place + ": expected an object");
    Level level{.mesh = {}, .epsilon = number(entry, place, "epsilon"), .r_min = number(entry, place, "r_min")};
    const bool endless = entry.contains("r_max") && entry["r_max"].is_null();
    level.r_max = endless ? std::numeric_limits<float>::infinity() : number(entry, place, "r_max");
    for (const char* key : {"vertices", "triangles"}) {
      if (entry.contains(key) && entry[key].is_number_unsigned()) continue;
      throw std::runtime_error(fmt::format("{}{}: expected a count", place, key));
    }
    const bool has_name = entry.contains("mesh") && entry["mesh"].is_string();
    if (!has_name || entry["mesh"].get<std::string>().empty()) {
      throw std::runtime_error(place + "mesh: expected the name of a file");
    }
    return level;
  }

  static void check(const Chain& chain) {
    const std::vector<Level>& levels = chain.levels;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const float epsilon_before = i == 0 ? 0 : levels[i - 1].epsilon;
      const float begin = i == 0 ? 0 : levels[i - 1].r_max;
      if (i == 0 ? levels[i].epsilon != 0 : !(levels[i].epsilon > epsilon_before)) {
        const char* const wanted = i == 0 ? "0" : "more than that of the level before";
        throw std::runtime_error(fmt::format("levels[{}].epsilon: expected {}, got {}", i, wanted, levels[i].epsilon));
      }
      if (levels[i].r_min != begin) {
        throw std::runtime_error(fmt::format("levels[{}].r_min: expected {}, where the level before ends, got {}", i,
                                             begin, levels[i].r_min));
      }
      if (!(levels[i].r_max > levels[i].r_min)) {
        throw std::runtime_error(fmt::format("levels[{}].r_max: expected more than r_min", i));
      }
    }
    if (!std::isinf(levels.back().r_max)) throw std::runtime_error("levels: the last one must have no r_max (null)");
  }

  void read_mesh(std::size_t i, const std::optional<glm::dvec3>& origin, scene::Mesh& mesh) const {
    const Json& entry = document_["levels"][i];
    mesh = scene::read_mesh_file((folder_ / entry["mesh"].get<std::string>()).string(), {.origin = origin});
    const auto expect = [&](const char* key, std::size_t count) {
      if (entry[key].get<std::uint64_t>() == count) return;
      throw std::runtime_error(fmt::format("levels[{}].{}: {} has {}, expected {}", i, key,
                                           entry["mesh"].get<std::string>(), count, entry[key].get<std::uint64_t>()));
    };
    expect("vertices", mesh.positions.size());
    expect("triangles", mesh.triangles.size());
  }

  fs::path folder_;
  Json document_;
};

}  // namespace

std::vector<std::string> chain_files(const std::string& path, std::size_t level_count) {
  if (!path.ends_with(kEnding) || path.ends_with(std::string("/") + kEnding) || path == kEnding) {
    throw std::invalid_argument(fmt::format("expected a name ending in {}, got '{}'", kEnding, path));
  }
  const std::string stem = path.substr(0, path.size() - std::string(kEnding).size());
  std::vector<std::string> files = {path};
  for (std::size_t i = 0; i < level_count; ++i) files.push_back(fmt::format("{}.{}.ply", stem, i));
  return files;
}

void write_chain(const Chain& chain, const std::string& path, std::span<const std::string> targets) {
  const std::vector<std::string> files = chain_files(path, chain.levels.size());
  if (targets.size() != files.size()) {
    throw std::invalid_argument(fmt::format("targets: expected {} files, got {}", files.size(), targets.size()));
  }
  for (std::size_t i = 0; i < chain.levels.size(); ++i) {
    write_file(files[i + 1], targets[i + 1], [&](std::ostream& out) { scene::write_ply(out, chain.levels[i].mesh); });
  }
  write_file(files[0], targets[0], [&](std::ostream& out) { out << document_of(chain, files); });
}

Chain load_chain(const std::string& path, const std::optional<glm::dvec3>& origin) {
  try {
    return Reader(path).read(origin);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

}  // namespace lkao::lod
