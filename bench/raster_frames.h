// Frames of the rasterised method, timed and compared with the CPU's exact query at the same receivers.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/study_scenes.h"
#include "lkao/gl.h"
#include "lkao/lkao.h"
#include "method/answers.h"
#include "raster/rasterizer.h"

namespace lkao::bench {

// What is drawn: a pass with its table, and the options of its frames.
struct FrameSetup {
  std::string name;
  PlaneMasks masks = PlaneMasks::nearest;
  gl::MaskPassSetup pass = {};
  Sidedness sidedness = Sidedness::two_sided;
  gl::RasterOptions raster = {};
};

// Table 2 of Laine & Karras 2010, Sec. 6: one-sided triangles, or the third test would have nothing to do. The pass's
// own test of the reach stays off, since it comes after them and would take their work.
std::vector<FrameSetup> cull_setups();

struct FrameResult {
  double milliseconds = 0;  // of draw and resolve, the median
  double mrays_per_second = 0;
  method::Deviation off;      // from the query
  gl::FragmentCounts counts;  // zeros where they were not wanted
};

struct FrameOptions {
  int ray_count = 128;
  int nearest_resolution = 128;  // of the tables
  int exact_resolution = 64;
  int round_count = 3;
};

// One scene at one radius.
class RasterFrames {
 public:
  RasterFrames(raster::Rasterizer& rasterizer, const StudyScene& scene, float radius, const FrameOptions& options);

  // Draws with one pass after the other; frames of a pass that differ in their options only take turns, round after
  // round. With `count`, fragments are counted by a further pass that is not timed.
  std::vector<FrameResult> draw(const std::vector<FrameSetup>& setups, bool count);

  // The query itself, on all threads.
  FrameResult query();

 private:
  // What frames are compared with: the query is asked once it is needed.
  const method::Answers& exact(Sidedness sidedness);
  RayOptions options_of(const FrameSetup& setup) const;
  PlaneMaskTable make_table(PlaneMasks masks) const;
  void start_pass(const FrameSetup& setup, const PlaneMaskTable& table, bool count);
  FrameResult compare(const FrameSetup& setup, const std::vector<double>& seconds);

  raster::Rasterizer& rasterizer_;
  const StudyScene& scene_;
  float radius_;
  FrameOptions options_;
  SamplePattern pattern_;
  std::map<Sidedness, method::Answers> exact_;
};

}  // namespace lkao::bench
