#include "bench/report/page.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include <zlib.h>

#include "bench/report/page_text.h"

namespace lkao::bench {
namespace {

constexpr float kOcclusionSteps = 65000;
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

void put_in(std::string& page, const std::string& place, const std::string& text) {
  page.replace(page.find(place), place.size(), text);
}

// Inside of <script>, nothing may look like its end.
std::string script_safe(std::string text) {
  for (std::size_t at = text.find("</"); at != std::string::npos; at = text.find("</", at)) text.replace(at, 2, "<\\/");
  return text;
}

}  // namespace

std::string encode_picture(const std::vector<std::uint16_t>& picture, int width) {
  std::vector<unsigned char> bytes(2 * picture.size());
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const std::uint16_t left = i % static_cast<std::size_t>(width) == 0 ? std::uint16_t{0} : picture[i - 1];
    const auto difference = static_cast<std::uint16_t>(picture[i] - left);
    bytes[i] = static_cast<unsigned char>(difference & 255);
    bytes[picture.size() + i] = static_cast<unsigned char>(difference >> 8);
  }
  return base64(deflate(bytes));
}

std::vector<std::uint16_t> steps_of_occlusion(const std::vector<float>& occlusion) {
  std::vector<std::uint16_t> steps;
  steps.reserve(occlusion.size());
  for (const float value : occlusion) {
    steps.push_back(std::isnan(value)
                        ? kNoReceiver
                        : static_cast<std::uint16_t>(std::clamp(value, 0.0f, 1.0f) * kOcclusionSteps + 0.5f));
  }
  return steps;
}

std::vector<std::uint16_t> steps_of_count(const std::vector<float>& counts) {
  std::vector<std::uint16_t> steps;
  steps.reserve(counts.size());
  for (const float count : counts) steps.push_back(std::isnan(count) ? kNoReceiver : static_cast<std::uint16_t>(count));
  return steps;
}

std::string make_page(const nlohmann::ordered_json& report) {
  std::string page = kPageHtml;
  put_in(page, "@STYLE@", kPageStyle);
  put_in(page, "@SCRIPT@", kPageScript);
  put_in(page, "@DATA@", script_safe(report.dump()));
  return page;
}

}  // namespace lkao::bench
