#include "lkao/c/batch.h"

#include "c_api/batches.h"
#include "c_api/handles.h"

using namespace lkao::c_api;

namespace {

class Outputs {
 public:
  Outputs(const lkao_outputs& to, std::size_t word_count)
      : occlusion_(to.occlusion, to.occlusion_stride, 1, "outputs->occlusion_stride"),
        bent_normals_(to.bent_normals, to.bent_normal_stride, 1, "outputs->bent_normal_stride"),
        masks_(to.masks, to.mask_stride, word_count, "outputs->mask_stride") {}

  lkao::QueryOutputs begin(std::size_t first, std::size_t count) {
    return {occlusion_.begin(first, count), bent_normals_.begin(first, count), masks_.begin(first, count)};
  }
  void finish(std::size_t first, std::size_t count) const {
    occlusion_.finish(first, count);
    bent_normals_.finish(first, count);
    masks_.finish(first, count);
  }

 private:
  Output<float> occlusion_;
  Output<glm::vec3> bent_normals_;
  Output<std::uint64_t> masks_;
};

}  // namespace

lkao_status lkao_ao_query_batch(const lkao_ao* ao, const lkao_receivers* receivers, const lkao_outputs* outputs,
                                const lkao_batch_options* options, lkao_query_report* report) {
  return guard(__func__, [&] {
    const lkao::AmbientOcclusion& found = object(ao, "ao");
    Outputs to(read(outputs, LKAO_OUTPUTS_INIT, "outputs"), static_cast<std::size_t>(found.pattern().word_count()));
    answer_batch(receivers, options, report,
                 [&](std::size_t first, std::span<const lkao::Receiver> part, std::uint64_t index,
                     const lkao::Progress& progress) {
                   const lkao::QueryReport part_report =
                       found.query(part, to.begin(first, part.size()), index, progress);
                   to.finish(first, part.size());
                   return part_report;
                 });
  });
}
