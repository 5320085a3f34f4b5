// lkao compare: how far two images are apart.
#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/commands.h"
#include "cli/json_output.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/parse.h"
#include "cli/parsed_option.h"
#include "cli/report.h"
#include "image/image.h"
#include "image/metrics.h"

namespace lkao::cli {
namespace {

constexpr double kDefaultGain = 8;

struct CompareOptions {
  std::string a;
  std::string b;
  std::optional<double> max_rmse;
  std::string difference;
  std::optional<double> gain;
  CommonOptions common;
};

// "occlusion" where both have it, else all channels that both have.
std::vector<std::string> channels_to_compare(const CompareOptions& options, const image::Image& a,
                                             const image::Image& b) {
  std::vector<std::string> common;
  for (const std::string& channel : a.channels) {
    if (b.channel(channel) < 0) continue;
    if (channel == "occlusion") return {channel};
    common.push_back(channel);
  }
  if (common.empty()) {
    throw std::runtime_error(fmt::format("'{}' and '{}' have no channel in common: {} against {}", options.a, options.b,
                                         fmt::join(a.channels, ", "), fmt::join(b.channels, ", ")));
  }
  return common;
}

void check_sizes(const CompareOptions& options, const image::Image& a, const image::Image& b) {
  if (a.width == b.width && a.height == b.height) return;
  throw std::runtime_error(fmt::format("the images differ in size: '{}' is {}x{}, '{}' is {}x{}", options.a, a.width,
                                       a.height, options.b, b.width, b.height));
}

std::vector<float> values_of(const image::Image& image, const std::vector<std::string>& channels) {
  const auto stride = static_cast<std::size_t>(image.channel_count());
  std::vector<float> values;
  values.reserve(image.pixels.size() / stride * channels.size());
  for (const std::string& channel : channels) {
    const auto first = static_cast<std::size_t>(image.channel(channel));
    for (std::size_t i = first; i < image.pixels.size(); i += stride) values.push_back(image.pixels[i]);
  }
  return values;
}

Json document_of(const CompareOptions& options, const std::vector<std::string>& channels,
                 const image::Metrics& metrics) {
  return {{"a", options.a},
          {"b", options.b},
          {"channels", channels},
          {"mae", metrics.mae},
          {"rmse", metrics.rmse},
          {"max_error", metrics.max_error},
          {"psnr", metrics.psnr},
          {"equal_8bit_share", metrics.equal_8bit_share},
          {"values", metrics.value_count}};
}

void print_table(const std::vector<std::string>& channels, const image::Metrics& metrics) {
  Table table;
  table.add("channels", fmt::format("{}", fmt::join(channels, ", ")));
  table.add("values", grouped(metrics.value_count));
  table.add("MAE", fmt::format("{:.6g}", metrics.mae));
  table.add("RMSE", fmt::format("{:.6g}", metrics.rmse));
  table.add("maximum", fmt::format("{:.6g}", metrics.max_error));
  table.add("PSNR", fmt::format("{:.2f} dB", metrics.psnr));
  table.add("equal at 8 bits", fmt::format("{:.3f} %", 100 * metrics.equal_8bit_share));
  table.print();
}

void write_difference(const std::string& path, const CompareOptions& options, const image::Image& difference) {
  const bool is_picture = ending_of(path) == ".png";
  const auto gain = static_cast<float>(options.gain.value_or(kDefaultGain));
  image::write_image(path, is_picture ? image::difference_preview(difference, gain) : difference);
}

ExitCode compare(const CompareOptions& options) {
  if (options.gain && ending_of(options.difference) != ".png") {
    throw std::invalid_argument("--gain needs a --difference of which a .png is made");
  }
  OutputFiles outputs({options.a, options.b});
  const JsonOutput json(options.common.json_path, outputs);
  const std::string difference_path = options.difference.empty() ? "" : outputs.claim_image(options.difference);
  const image::Image a = image::read_image(options.a);
  const image::Image b = image::read_image(options.b);
  check_sizes(options, a, b);
  const std::vector<std::string> channels = channels_to_compare(options, a, b);
  const image::Metrics metrics = image::compare(values_of(a, channels), values_of(b, channels));

  if (!difference_path.empty()) write_difference(difference_path, options, image::difference(a, b, channels));
  json.write_and_commit(document_of(options, channels, metrics));
  if (options.common.wants_table()) print_table(channels, metrics);
  if (!options.max_rmse || metrics.rmse <= *options.max_rmse) return kSuccess;
  fmt::print(stderr, "lkao: RMSE {:.6g} is above --max-rmse {:g}\n", metrics.rmse, *options.max_rmse);
  return kOverLimit;
}

void add_options(CLI::App& app, CompareOptions& options) {
  app.add_option("a", options.a, "An image")->required()->type_name("A");
  app.add_option("b", options.b, "Another of the same size")->required()->type_name("B");
  add_parsed(app, "--max-rmse", options.max_rmse, parse_non_negative_number, "Exit with 1 where the RMSE is above X")
      ->type_name("X");
  app.add_option("--difference", options.difference, "Write B - A: .exr as it is, .png in red (above) and blue (below)")
      ->type_name("FILE");
  add_parsed(app, "--gain", options.gain, parse_positive_number, "A .png is in full colour from 1 / X on (default: 8)")
      ->type_name("X");
  add_common_options(app, options.common);
  app.footer(
      "Compares the channel occlusion where both images have it, else all channels that both have.\n"
      "The PSNR of equal images is infinite; JSON has null for it.");
}

}  // namespace

Command add_compare_command(CLI::App& program) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* const app = program.add_subcommand("compare", "Measure how far two images are apart");
  add_options(*app, *options);
  const auto run = [options] { return with_threads(options->common.thread_count, [&] { return compare(*options); }); };
  return {app, run};
}

}  // namespace lkao::cli
