// Steps that baking into meshes and into textures share.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "cli/baking.h"
#include "cli/progress_bar.h"
#include "lkao/ambient_occlusion.h"
#include "method/method.h"

namespace lkao::cli {

// The scene, what surrounds it, its radius and its normals.
void load_for_baking(const BakingOptions& options, Baking& result, ProgressBar& progress);

// A method that is ready to answer about a baking's scene. What it did is added up in the baking's batch.
class Asker {
 public:
  // Builds the hierarchy. All must outlive it.
  Asker(const BakingOptions& options, Baking& result, ProgressBar& progress);

  // Receiver k has index k. With a progress bar.
  std::vector<float> operator()(std::span<const Receiver> receivers) const;
  // Receiver k has index first_index + k.
  void answer(std::span<const Receiver> receivers, const QueryOutputs& outputs, std::uint64_t first_index) const;

 private:
  int ray_count_;
  Baking& result_;
  ProgressBar& progress_;
  std::unique_ptr<method::Method> method_;
};

}  // namespace lkao::cli
