#include "scene/formats/gltf/uri.h"

#include <array>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "scene/formats/gltf/value.h"
#include "scene/formats/text.h"

namespace lkao::scene::gltf {

namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

// "%" without two digits behind it stands for itself.
std::string decode_percent(std::string_view text) {
  std::string decoded;
  decoded.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_escape =
        text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 && hex_digit(text[i + 2]) >= 0;
    decoded += is_escape ? static_cast<char>(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2])) : text[i];
    if (is_escape) i += 2;
  }
  return decoded;
}

constexpr std::array<std::int8_t, 256> kBase64Digits = [] {
  constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<std::int8_t, 256> digits{};
  digits.fill(-1);
  for (std::size_t i = 0; i < kAlphabet.size(); ++i) {
    digits[static_cast<unsigned char>(kAlphabet[i])] = static_cast<std::int8_t>(i);
  }
  return digits;
}();

// The padding at the end may be missing.
std::string decode_base64(std::string_view text) {
  while (text.ends_with('=')) text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() * 3 / 4);
  std::uint32_t bits = 0;
  int bit_count = 0;
  for (const char c : text) {
    const std::int8_t digit = kBase64Digits[static_cast<unsigned char>(c)];
    if (digit < 0) throw std::runtime_error(fmt::format("{} is no character of base64", in_quotes({&c, 1})));
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    bit_count += 6;
    if (bit_count < 8) continue;
    bit_count -= 8;
    bytes += static_cast<char>(bits >> bit_count & 0xff);
  }
  return bytes;
}

// "file" of "file:///model.bin"; nothing where the URI is relative.
std::optional<std::string_view> scheme_of(std::string_view uri) {
  const std::size_t end = uri.find(':');
  if (end == uri.npos || end == 0) return std::nullopt;
  const std::string_view scheme = uri.substr(0, end);
  for (const char c : scheme) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '+' && c != '-' && c != '.') return std::nullopt;
  }
  return scheme;
}

}  // namespace

bool is_data_uri(std::string_view uri) { return uri.size() >= 5 && equal_but_for_case(uri.substr(0, 5), "data:"); }

bool is_relative_uri(std::string_view uri) { return !scheme_of(uri); }

std::string encode_uri(std::string_view path) {
  constexpr std::string_view kPlain = "-._~/";
  std::string uri;
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = byte < 0x80 && (std::isalnum(byte) != 0 || kPlain.find(c) != kPlain.npos);
    uri += is_plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return uri;
}

std::string decode_data_uri(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == uri.npos) throw std::runtime_error("its data: URI has no comma");
  std::string content = decode_percent(uri.substr(comma + 1));
  return uri.substr(0, comma).ends_with(";base64") ? decode_base64(content) : content;
}

std::string resolve_uri(const std::string& path, std::string_view uri) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const std::filesystem::path as_written = folder / std::string(uri);
  std::error_code error;
  const std::filesystem::path decoded = folder / decode_percent(uri);
  if (!std::filesystem::exists(decoded, error) && std::filesystem::exists(as_written, error)) return as_written;
  if (const std::optional<std::string_view> scheme = scheme_of(uri)) {
    throw std::runtime_error(fmt::format("URIs of the scheme {} are not supported", in_quotes(*scheme)));
  }
  return decoded;
}

}  // namespace lkao::scene::gltf
