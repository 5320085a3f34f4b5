// A method: a way to answer receivers. One file each; list.cpp has them all.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "lkao/ambient_occlusion.h"
#include "method/occluders.h"
#include "method/question.h"
#include "method/settings.h"
#include "scene/camera.h"

namespace lkao::method {

// What a method can do.
struct Abilities {
  bool masks = true;             // it tells which rays are blocked
  bool bent_normals = true;      // it tells whence light comes
  bool levels = true;            // it takes levels of detail
  bool infinite_lengths = true;  // Question::has_infinite_lengths()
  bool any_receivers = true;     // false: only all pixels of a view at once
  bool infinite_radius = true;
  bool min_distance = true;  // Question::min_distance
  bool one_sided = true;     // Sidedness::one_sided
  bool uniform_weighting = true;
  bool lights = false;  // Question::light
  bool holes = false;   // Mesh::holes; otherwise such triangles are whole
  bool constant_falloff = true, linear_falloff = true, other_falloffs = true;
};

// What a camera sees. The receivers in question are its pixels.
struct View {
  const scene::Camera& camera;
  const scene::ReceiverImage& image;
};

struct Task {
  Occluders& occluders;
  const Question& question;
  std::optional<View> view = {};  // a must unless the method takes any receivers
};

struct Answered {
  QueryReport report;  // blocked rays may be left uncounted
  double seconds = 0;  // of the method's own work; where it draws, the median of several frames
};

// What a method says of itself in a report, for programs and for people.
struct Remarks {
  nlohmann::ordered_json keys = nlohmann::ordered_json::object();
  std::vector<std::pair<std::string, std::string>> rows = {};  // a label and a text
};

class Method {
 public:
  explicit Method(const Abilities& abilities) : abilities_(abilities) {}
  virtual ~Method() = default;
  Method(const Method&) = delete;
  Method& operator=(const Method&) = delete;

  const Abilities& abilities() const { return abilities_; }
  // What computes, where it is not the CPU.
  virtual std::string device() const { return {}; }

  // Throws std::runtime_error with one line where views may not be so large.
  virtual void require_size(int /*width*/, int /*height*/) const {}

  // From now on answers are those of this task, of which nothing is needed afterwards. May be called again for another
  // one. Throws std::exception with one line.
  virtual void prepare(const Task& task) = 0;
  // Of what prepare() made for this method alone: Occluders has what methods share.
  virtual double build_seconds() const { return 0; }

  // Answers as AmbientOcclusion::query does. Without the ability of masks or bent normals these outputs must be empty.
  virtual Answered answer(std::span<const Receiver> receivers, const QueryOutputs& outputs,
                          std::uint64_t first_index) = 0;

  // After answers were given.
  virtual Remarks remarks() const { return {}; }

 private:
  Abilities abilities_;
};

// What is known of a method before it runs.
struct MethodKind {
  std::string_view word = {};     // given by the list
  std::string_view summary = {};  // what it does, after "bvh: "
  std::vector<const Setting*> settings = {};
  // Some depend on settings.
  Abilities (*abilities)(const Settings&) = nullptr;
  // Throws std::runtime_error with one line where this machine lacks what it needs. Null, as all members but the word,
  // where this program was built without.
  std::unique_ptr<Method> (*open)(const Settings&) = nullptr;

  bool is_built() const { return open != nullptr; }
};

}  // namespace lkao::method
