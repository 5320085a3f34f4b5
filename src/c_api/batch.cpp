// Batches: the caller's arrays, a part of them at a time, as the C++ interface wants them.
#include "lkao/c/batch.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <vector>

#include "c_api/arrays.h"
#include "c_api/convert.h"
#include "c_api/handles.h"
#include "c_api/versioned.h"

using namespace lkao::c_api;

namespace {

// Receivers that are answered at a time: enough to keep all threads busy, and some megabytes.
constexpr std::size_t kPart = std::size_t{1} << 15;

class Receivers {
 public:
  explicit Receivers(const lkao_receivers& from)
      : count_(from.count),
        positions_(from.positions, from.position_stride, "receivers->position_stride"),
        normals_(from.normals, from.normal_stride, "receivers->normal_stride"),
        geometric_normals_(from.geometric_normals, from.geometric_normal_stride, "receivers->geometric_normal_stride"),
        excluded_(from.excluded_primitives, from.excluded_primitive_stride, "receivers->excluded_primitive_stride"),
        instances_(from.excluded_instances, from.excluded_instance_stride, "receivers->excluded_instance_stride"),
        groups_(from.occluder_groups, from.occluder_group_stride, "receivers->occluder_group_stride") {
    if (count_ == 0) return;
    needed(from.positions, "receivers->positions");
    needed(from.normals, "receivers->normals");
  }

  std::size_t count() const { return count_; }

  // Those from `first` on.
  void get(std::size_t first, std::span<lkao::Receiver> part) const {
    for (std::size_t k = 0; k < part.size(); ++k) {
      part[k] = {};
      positions_.get(first + k, &part[k].position);
      normals_.get(first + k, &part[k].normal);
      if (geometric_normals_) geometric_normals_.get(first + k, &part[k].geometric_normal);
      if (excluded_) excluded_.get(first + k, &part[k].excluded_primitive);
      if (instances_) instances_.get(first + k, &part[k].excluded_instance);
      if (groups_) groups_.get(first + k, &part[k].occluder_groups);
    }
  }

 private:
  std::size_t count_;
  Strided<const float, 3> positions_, normals_, geometric_normals_;
  Strided<const std::uint32_t, 1> excluded_, instances_, groups_;
};

// One array of answers. Where the caller's is not packed, those of a part wait in one of its own.
template <typename Value>
class Output {
 public:
  // `width` values make an entry.
  Output(void* first, std::size_t stride, std::size_t width, const char* name)
      : first_(static_cast<unsigned char*>(first)),
        width_(width),
        stride_(checked_stride(stride, width * sizeof(Value), name)) {}

  // Where answers `first` and on go: empty where they are not wanted.
  std::span<Value> begin(std::size_t first, std::size_t count) {
    if (first_ == nullptr) return {};
    if (is_packed()) return {reinterpret_cast<Value*>(first_ + first * stride_), count * width_};
    waiting_.resize(count * width_);
    return waiting_;
  }
  void finish(std::size_t first, std::size_t count) const {
    if (first_ == nullptr || is_packed()) return;
    for (std::size_t k = 0; k < count; ++k) {
      std::memcpy(first_ + (first + k) * stride_, waiting_.data() + k * width_, width_ * sizeof(Value));
    }
  }

 private:
  bool is_packed() const { return stride_ == width_ * sizeof(Value); }

  unsigned char* first_;
  std::size_t width_, stride_;
  std::vector<Value> waiting_;
};

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

void add(lkao_query_report& sum, const lkao::QueryReport& part) {
  sum.receiver_count += part.receiver_count;
  sum.invalid_receiver_count += part.invalid_receiver_count;
  sum.ray_count += part.ray_count;
  sum.blocked_ray_count += part.blocked_ray_count;
}

// The caller's progress, to which all parts are one call.
lkao::Progress progress_from(const lkao::Progress& progress, std::size_t first, std::size_t count) {
  if (!progress) return {};
  return [=](std::size_t done, std::size_t) { return progress(first + done, count); };
}

lkao_query_report answer(const lkao::AmbientOcclusion& ao, const Receivers& receivers, Outputs& outputs,
                         std::uint64_t first_index, const lkao::Progress& progress) {
  lkao_query_report report = LKAO_QUERY_REPORT_INIT;
  std::vector<lkao::Receiver> part;
  for (std::size_t first = 0; first < receivers.count(); first += part.size()) {
    part.resize(std::min(kPart, receivers.count() - first));
    receivers.get(first, part);
    add(report, ao.query(part, outputs.begin(first, part.size()), first_index + first,
                         progress_from(progress, first, receivers.count())));
    outputs.finish(first, part.size());
  }
  return report;
}

}  // namespace

lkao_status lkao_ao_query_batch(const lkao_ao* ao, const lkao_receivers* receivers, const lkao_outputs* outputs,
                                const lkao_batch_options* options, lkao_query_report* report) {
  return guard(__func__, [&] {
    const lkao::AmbientOcclusion& found = object(ao, "ao");
    const Receivers from(read(receivers, LKAO_RECEIVERS_INIT, "receivers"));
    Outputs to(read(outputs, LKAO_OUTPUTS_INIT, "outputs"), static_cast<std::size_t>(found.pattern().word_count()));
    const lkao_batch_options how = read_or_defaults(options, LKAO_BATCH_OPTIONS_INIT, "options");
    if (report != nullptr) check_size(report, "report");
    lkao_query_report result = LKAO_QUERY_REPORT_INIT;
    run_on_threads(how.thread_count, "options->thread_count", [&] {
      result = answer(found, from, to, how.first_index, progress_of(how.progress, how.progress_user));
    });
    if (report != nullptr) write(result, report);
  });
}
