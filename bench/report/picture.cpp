#include "bench/report/picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include <zlib.h>

#include <fmt/format.h>

namespace lkao::bench {
namespace {

constexpr int kRaysSteps = 16384, kMostRays = 1024, kFewestRays = 16, kFineSteps = 1000, kCoarseSteps = 250;
constexpr double kLargeError = 10.0 / kCoarseSteps;  // RMSE
constexpr std::uint16_t kNoReceiver = 65535;

std::vector<unsigned char> deflate(const std::vector<unsigned char>& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<unsigned char> packed(size);
  if (compress2(packed.data(), &size, bytes.data(), static_cast<uLong>(bytes.size()), Z_BEST_COMPRESSION) != Z_OK) {
    throw std::runtime_error("a picture of the report could not be deflated");
  }
  packed.resize(size);
  return packed;
}

std::string base64(const std::vector<unsigned char>& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

// Halves go up, as in the page: 0.5 of both is the same there.
int step_of(float value, int steps) {
  return std::isnan(value) ? 0 : static_cast<int>(std::floor(static_cast<double>(value) * steps + 0.5));
}

double rmse_of(const std::vector<float>& picture, const std::vector<float>& right) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const double error = static_cast<double>(picture[i]) - static_cast<double>(right[i]);
    if (std::isnan(error)) continue;
    sum += error * error;
    ++count;
  }
  return count == 0 ? 0 : std::sqrt(sum / static_cast<double>(count));
}

// The fewest steps that lose nothing, or nothing that matters.
int steps_for(const std::vector<float>& occlusion, const std::vector<float>& rays) {
  for (int steps = kFewestRays; steps <= kMostRays; steps *= 2) {
    const auto is_step = [steps](float value) {
      const float scaled = value * static_cast<float>(steps);
      return std::isnan(value) || scaled == std::round(scaled);
    };
    if (std::all_of(occlusion.begin(), occlusion.end(), is_step)) return steps;
  }
  return rmse_of(occlusion, rays) < kLargeError ? kFineSteps : kCoarseSteps;
}

// What neighbours that are there already let expect of pixel i.
int expected(const std::vector<int>& values, std::size_t i, std::size_t width) {
  const bool has_left = i % width != 0, has_up = i >= width;
  const int left = has_left ? values[i - 1] : 0, up = has_up ? values[i - width] : 0;
  if (!has_left) return up;
  if (!has_up) return left;
  const int corner = values[i - width - 1];
  return std::max(std::min(left, up), std::min(std::max(left, up), left + up - corner));
}

// Small numbers for small differences of either sign.
std::uint16_t folded(int difference) {
  return static_cast<std::uint16_t>(difference < 0 ? -2 * difference - 1 : 2 * difference);
}

std::string packed(const std::vector<float>& picture, const std::vector<int>& differences, bool is_smooth,
                   std::size_t width) {
  const std::size_t count = picture.size();
  std::vector<unsigned char> bytes(2 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const int from = is_smooth ? expected(differences, i, width) : 0;
    const std::uint16_t code = std::isnan(picture[i]) ? kNoReceiver : folded(differences[i] - from);
    bytes[i] = static_cast<unsigned char>(code & 255);
    bytes[count + i] = static_cast<unsigned char>(code >> 8);
  }
  return base64(deflate(bytes));
}

}  // namespace

PictureEncoder::PictureEncoder(const std::vector<float>& rays, int width) : rays_(rays), width_(width) {
  put("rays", rays, kRaysSteps, false);
  for (float& value : rays_) {
    if (!std::isnan(value)) value = static_cast<float>(step_of(value, kRaysSteps)) / kRaysSteps;
  }
}

void PictureEncoder::add(const std::string& name, const std::vector<float>& occlusion) {
  put(name, occlusion, steps_for(occlusion, rays_), true);
}

void PictureEncoder::add_counts(const std::string& name, const std::vector<float>& counts) {
  put(name, counts, 1, false);
}

void PictureEncoder::put(const std::string& name, const std::vector<float>& values, int steps, bool has_base) {
  std::vector<int> differences(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    differences[i] = step_of(values[i], steps) - (has_base ? step_of(rays_[i], steps) : 0);
  }
  const auto width = static_cast<std::size_t>(width_);
  const std::string plain = packed(values, differences, false, width);
  const std::string smooth = packed(values, differences, true, width);
  const bool is_smooth = smooth.size() < plain.size();
  const std::string& data = is_smooth ? smooth : plain;
  const auto [same, is_new] = known_.try_emplace(fmt::format("{} {} {}", steps, is_smooth, data), name);
  if (is_new) {
    pictures_[name] = {{"steps", steps}, {"coding", is_smooth ? "smooth" : "plain"}, {"data", data}};
  } else {
    pictures_[name] = {{"as", same->second}};
  }
}

}  // namespace lkao::bench
