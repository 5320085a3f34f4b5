// What methods in screen space have in common: they gather from the pixels around a receiver, of a picture that may
// have a margin, for all or every n-th pixel, and their noise may be filtered.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "method/frame.h"
#include "method/method.h"
#include "raster/screen_drawer.h"

namespace lkao::method {

// Any of them has these settings; `own` come after them.
std::vector<const Setting*> screen_settings(std::vector<const Setting*> own);
// Without masks, bent normals, levels, minimum distance, an infinite radius, and with one falloff, which counts as
// constant: their own.
Abilities screen_abilities();

// A method: a pass as a member, which is made after this base has made the context current.
class ScreenMethod : public Method {
 public:
  std::string device() const final;
  void require_size(int width, int height) const final;
  void prepare(const Task& task) final;
  Answered answer(std::span<const Receiver> receivers, const QueryOutputs& outputs, std::uint64_t first_index) final;
  Remarks remarks() const final;

 protected:
  // `estimator`: the method's own settings that --converged takes the place of. Throws std::invalid_argument where both
  // are given, or --step or --filter with it.
  ScreenMethod(const Settings& settings, const Abilities& abilities, const std::vector<const Setting*>& estimator);

  // The method's own assumptions are to be solved: thousands of samples.
  bool is_converged() const { return is_converged_; }

  // Radius and seed of the frames to come.
  virtual void set_question(const Question& question, const scene::Mesh& mesh) = 0;
  virtual void draw(const gl::GBuffer& g_buffer, const gl::Camera& camera, const gl::OcclusionTarget& to) = 0;
  // After the device's and the frame's.
  virtual void add_remarks(Remarks& remarks) const = 0;

 private:
  bool is_converged_;
  int margin_;
  raster::Smoothing smoothing_;
  raster::ScreenDrawer drawer_;
  int frame_width_ = 0;  // with the margin
  FrameTimes times_;
};

}  // namespace lkao::method
