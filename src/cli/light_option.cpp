#include "cli/light_option.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "cli/parse.h"

namespace lkao::cli {
namespace {

// The first `count` of values between commas, and what is behind them.
std::pair<std::string, std::string> split_after(const std::string& text, int count) {
  std::size_t end = 0;
  for (int i = 0; i < count && end != std::string::npos; ++i) end = text.find(',', i == 0 ? 0 : end + 1);
  if (end == std::string::npos) return {text, ""};
  return {text.substr(0, end), text.substr(end + 1)};
}

}  // namespace

LightOption parse_light(const std::string& text) {
  const auto comma_count = std::count(text.begin(), text.end(), ',');
  if (comma_count != 3 && comma_count != 6) {
    throw std::invalid_argument(
        fmt::format("expected x,y,z,radius of a sphere or x,y,z,radius,nx,ny,nz of a disc, got '{}'", text));
  }
  const auto [position, behind_position] = split_after(text, 3);
  const auto [radius, normal] = split_after(behind_position, 1);
  LightOption light{parse_position(position), static_cast<float>(parse_positive_number(radius)), std::nullopt};
  if (comma_count == 3) return light;
  light.normal = parse_vector(normal);
  if (*light.normal == glm::vec3(0)) throw std::invalid_argument("the normal of a disc must not be zero");
  return light;
}

AreaLight area_light(const LightOption& option, const glm::dvec3& origin) {
  const glm::vec3 position(option.position - origin);
  if (option.normal) return DiscLight{position, *option.normal, option.radius};
  return SphereLight{position, option.radius};
}

Json light_json(const LightOption& option) {
  Json json = {{"position", vector_json(option.position)}, {"radius", option.radius}};
  if (option.normal) json["normal"] = vector_json(*option.normal);
  return json;
}

}  // namespace lkao::cli
