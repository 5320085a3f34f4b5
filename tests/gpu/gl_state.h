// All of OpenGL's state that a pass may change, and a state that no pass expects.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gpu/gl/objects.h"
#include "gpu/gl/program.h"

namespace lkao::gl::tests {

// All that a renderer may have set, by name.
using Snapshot = std::map<std::string, std::vector<double>>;

Snapshot take_snapshot();

// The names of what is no longer as it was.
std::vector<std::string> changes_since(const Snapshot& before);

// The unlikely: everything set in a way that would spoil a pass that relies on it.
class OddState {
 public:
  OddState();
  ~OddState();

 private:
  void bind() const;
  static void set_pipeline();

  Buffer buffer_;
  Texture texture_, array_, view_;
  Sampler sampler_;
  Framebuffer framebuffer_;
  VertexArray vertex_array_;
  ProgramObject program_;
};

}  // namespace lkao::gl::tests
