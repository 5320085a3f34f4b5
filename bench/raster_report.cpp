#include "bench/raster_report.h"

namespace lkao::bench {

std::vector<Measurement> raster_measurements(const RasterStudy& study) {
  std::vector<Measurement> measurements;
  const FrameResult& last = study.results.back();
  for (std::size_t i = 0; i < study.results.size(); ++i) {
    const FrameResult& r = study.results[i];
    const bool has_counts = last.counts.drawn > 0 && r.counts.drawn > 0;
    const auto survivors = static_cast<double>(r.counts.survivors);
    const auto if_counted = [&](double number) { return has_counts ? Value(number) : Value(); };
    measurements.push_back({{"scene", study.scene},
                            {"radius", study.radius},
                            {"study", study.name},
                            {"variant", study.variants[i]},
                            {"milliseconds", r.milliseconds},
                            {"mrays_per_second", r.mrays_per_second},
                            {"ray_mismatch_rate", r.off.mismatch_rate},
                            {"mae", r.off.error.mae},
                            {"rmse", r.off.error.rmse},
                            {"max_error", r.off.error.max_error},
                            {"equal_8bit_share", r.off.error.equal_8bit_share},
                            {"equal_8bit_percent", 100 * r.off.error.equal_8bit_share},
                            {"drawn_fragments", r.counts.drawn},
                            {"surviving_fragments", r.counts.survivors},
                            {"masks", r.counts.masks},
                            {"surviving_mfragments", if_counted(1e-6 * survivors)},
                            {"relative_fragments", if_counted(survivors / static_cast<double>(last.counts.survivors))},
                            {"relative_speed", if_counted(last.milliseconds / r.milliseconds)}});
  }
  return measurements;
}

Columns raster_csv_columns() {
  return {{"scene"},
          {"radius", "{:g}"},
          {"study"},
          {"variant"},
          {"milliseconds", "{:.5g}"},
          {"mrays_per_second", "{:.5g}"},
          {"ray_mismatch_rate", "{:.4g}"},
          {"mae", "{:.4g}"},
          {"rmse", "{:.4g}"},
          {"max_error", "{:.4g}"},
          {"equal_8bit_share", "{:.6f}"},
          {"drawn_fragments"},
          {"surviving_fragments"},
          {"masks"}};
}

Columns raster_table_columns() {
  return {{"scene", "{}", -14},
          {"radius", "{:g}", 7},
          {"study", "{}", -10},
          {"variant", "{}", -28},
          kBar,
          {"milliseconds", "{:.2f}", 9, "ms"},
          {"mrays_per_second", "{:.2f}", 8, "Mrays/s"},
          kBar,
          {"ray_mismatch_rate", "{:.2g}", 9, "mismatch"},
          {"mae", "{:.2g}", 9, "MAE"},
          {"equal_8bit_percent", "{:.2f}%", 7, "8 bits"},
          kBar,
          {"surviving_mfragments", "{:.2f}", 8, "Mfrag"},
          {"relative_fragments", "{:.2f}", 6, "#frag"},
          {"relative_speed", "{:.2f}", 6, "perf"}};
}

}  // namespace lkao::bench
