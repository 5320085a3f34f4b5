#include "raster_report.h"

#include <fmt/format.h>

namespace lkao::bench {
namespace {

std::string relative(const FrameResult& result, const FrameResult& last) {
  if (last.counts.drawn == 0 || result.counts.drawn == 0) return fmt::format(" | {:>8} {:>6} {:>6}", "-", "-", "-");
  const auto survivors = static_cast<double>(result.counts.survivors);
  return fmt::format(" | {:8.2f} {:6.2f} {:6.2f}", 1e-6 * survivors,
                     survivors / static_cast<double>(last.counts.survivors), last.milliseconds / result.milliseconds);
}

}  // namespace

std::string raster_csv_heading() {
  return "scene,radius,study,variant,milliseconds,mrays_per_second,ray_mismatch_rate,mae,rmse,max_error,"
         "equal_8bit_share,drawn_fragments,surviving_fragments,masks\n";
}

std::string raster_csv_rows(const RasterStudy& study) {
  std::string rows;
  for (std::size_t i = 0; i < study.results.size(); ++i) {
    const FrameResult& r = study.results[i];
    rows += fmt::format("{},{:g},{},{},{:.5g},{:.5g},{:.4g},{:.4g},{:.4g},{:.4g},{:.6f},{},{},{}\n", study.scene,
                        study.radius, study.name, study.variants[i], r.milliseconds, r.mrays_per_second,
                        r.off.mismatch_rate, r.off.error.mae, r.off.error.rmse, r.off.error.max_error,
                        r.off.error.equal_8bit_share, r.counts.drawn, r.counts.survivors, r.counts.masks);
  }
  return rows;
}

std::string raster_table_heading() {
  return fmt::format("{:14} {:>7} {:10} {:28} | {:>9} {:>8} | {:>9} {:>9} {:>7} | {:>8} {:>6} {:>6}\n", "scene",
                     "radius", "study", "variant", "ms", "Mrays/s", "mismatch", "MAE", "8 bits", "Mfrag", "#frag",
                     "perf");
}

std::string raster_table_rows(const RasterStudy& study) {
  std::string rows;
  for (std::size_t i = 0; i < study.results.size(); ++i) {
    const FrameResult& r = study.results[i];
    rows += fmt::format("{:14} {:7g} {:10} {:28} | {:9.2f} {:8.2f} | {:9.2g} {:9.2g} {:6.2f}%{}\n", study.scene,
                        study.radius, study.name, study.variants[i], r.milliseconds, r.mrays_per_second,
                        r.off.mismatch_rate, r.off.error.mae, 100 * r.off.error.equal_8bit_share,
                        relative(r, study.results.back()));
  }
  return rows;
}

}  // namespace lkao::bench
