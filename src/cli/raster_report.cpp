// What of the rasterised method needs no OpenGL.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "cli/parsed_option.h"
#include "cli/raster_method.h"

namespace lkao::cli {
namespace {

const char* name_of(PlaneMasks masks) { return masks == PlaneMasks::must_may ? "exact" : "nearest"; }

template <typename Value>
void copy_part(const std::vector<Value>& all, std::size_t first, std::span<Value> part) {
  std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(first), part.size(), part.begin());
}

}  // namespace

void add_raster_options(CLI::App& app, RasterOptions& options) {
  const auto parse_device = [](const std::string& text) {
    return parse_choice<gl::Device>(
        text,
        {{"software", gl::Device::software}, {"hardware", gl::Device::hardware}, {"auto", gl::Device::automatic}});
  };
  add_parsed(app, "--gl", options.device, parse_device,
             "What the raster method draws with: auto takes hardware where there is any (default: auto)")
      ->type_name("software|hardware|auto");
  const auto parse_masks = [](const std::string& text) {
    return parse_choice<PlaneMasks>(text, {{"exact", PlaneMasks::must_may}, {"nearest", PlaneMasks::nearest}});
  };
  add_parsed(app, "--masks", options.masks, parse_masks,
             "What the raster method takes from its table: exact tests the rays that a cell leaves open, nearest does "
             "not (default: exact)")
      ->type_name("exact|nearest");
}

void add_raster_rows(Table& table, const RasterReport& report) {
  table.add("OpenGL", fmt::format("{}{}, {}, {}", report.renderer, report.is_software ? ", software" : "",
                                  report.geometry, report.accumulator));
  const std::string draws = report.draw_count == 1 ? "drawn once" : fmt::format("median of {}", report.draw_count);
  table.add("frame", fmt::format("{:.2f} ms, {}, {} masks; {:.3f} s to set up", 1000 * report.draw_seconds, draws,
                                 name_of(report.masks), report.setup_seconds));
}

void add_raster_keys(Json& document, const RasterReport& report) {
  document["masks"] = name_of(report.masks);
  document["gl"] = {{"renderer", report.renderer},
                    {"version", report.version},
                    {"software", report.is_software},
                    {"geometry", report.geometry},
                    {"accumulator", report.accumulator},
                    {"setup_seconds", report.setup_seconds},
                    {"draw_milliseconds", 1000 * report.draw_seconds},
                    {"draw_count", report.draw_count}};
}

void limit_gl_threads(std::optional<int> thread_count) {
  if (!thread_count) return;
  // Mesa's llvmpipe: 0 is the calling thread alone.
  setenv("LP_NUM_THREADS", std::to_string(*thread_count == 1 ? 0 : *thread_count).c_str(), 0);
}

Answer RasterFrame::answer() const {
  return [this](std::span<const Receiver> receivers, const QueryOutputs& outputs, std::uint64_t first_index) {
    const auto first = static_cast<std::size_t>(first_index);
    const std::size_t word_count = mask_words.size() / occlusion.size();
    copy_part(occlusion, first, outputs.occlusion);
    copy_part(bent_normals, first, outputs.bent_normals);
    copy_part(mask_words, first * word_count, outputs.mask_words);
    QueryReport counts;
    counts.receiver_count = receivers.size();
    for (std::size_t k = 0; k < receivers.size(); ++k)
      counts.invalid_receiver_count += std::isnan(occlusion[first + k]);
    counts.ray_count = (counts.receiver_count - counts.invalid_receiver_count) * static_cast<std::uint64_t>(ray_count);
    return counts;
  };
}

}  // namespace lkao::cli
