#include "fuzz/query_case.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "bvh/usable_triangle.h"
#include "fuzz/byte_source.h"
#include "fuzz/soup.h"

namespace lkao::tests {
namespace {

struct NamedPattern {
  SamplePattern pattern;
  std::string name;
  std::optional<PlaneMaskTable> table;
};

// A pattern of the library's, kept: some take longer than all the rest of a case. Tables only where they are small.
const NamedPattern& kept_pattern(PatternKind kind, int ray_count, const Falloff& falloff) {
  static std::map<std::string, NamedPattern> patterns;
  const std::string name = fmt::format("{} {} {}", pattern_kind_name(kind), ray_count, falloff.name());
  auto found = patterns.find(name);
  if (found == patterns.end()) {
    const SamplePattern pattern = SamplePattern::make(kind, ray_count, falloff, 1);
    std::optional<PlaneMaskTable> table;
    if (ray_count == 64 || ray_count % 32 == 1) table.emplace(pattern, PlaneMaskTableOptions{.resolution = 32});
    found = patterns.emplace(name, NamedPattern{pattern, name, table}).first;
  }
  return found->second;
}

// Directions that need not be spread at all, and lengths down to 0.
NamedPattern custom_pattern(ByteSource& bytes) {
  const int ray_count = 1 + static_cast<int>(bytes.below(192));
  // Over the hemisphere, or towards a scene that is a dot.
  const float spread = bytes.once_in(3) ? std::pow(10.0f, -5 * bytes.share()) : 1;
  std::vector<glm::vec2> points;
  std::vector<float> lengths;
  lut::RandomStream random(bytes.next_byte());
  for (int i = 0; i < ray_count; ++i) {
    const float radius = spread * std::sqrt(uniform(random, 0, 0.9999f));
    const float turn = uniform(random, 0, 2 * std::numbers::pi_v<float>);
    points.emplace_back(radius * std::cos(turn), radius * std::sin(turn));
    lengths.push_back(uniform(random, 0, 1));
  }
  // Along the axes, all the same, without length.
  for (int i = 0; i < 16; ++i) {
    const auto ray = static_cast<std::size_t>(bytes.below(static_cast<std::size_t>(ray_count)));
    constexpr glm::vec2 kPoints[] = {{0, 0}, {0.5f, 0}, {0, -0.5f}, {0.999999f, 0}};
    constexpr float kLengths[] = {1, 0, 1e-6f, 0.5f};
    points[ray] = bytes.pick(kPoints);
    lengths[ray] = bytes.pick(kLengths);
  }
  return {SamplePattern::from_disk(points, lengths), fmt::format("custom {}", ray_count), std::nullopt};
}

NamedPattern decode_pattern(ByteSource& bytes) {
  static const Falloff kFalloffs[] = {Falloff::constant(), Falloff::constant(), Falloff::linear(), Falloff::smooth(),
                                      Falloff::exponential()};
  constexpr PatternKind kKinds[] = {PatternKind::lloyd, PatternKind::paper, PatternKind::fibonacci, PatternKind::sobol,
                                    PatternKind::random};
  // Small patterns are cheap and find as much; large ones exercise the last words of a mask.
  constexpr int kCounts[] = {64, 64, 64, 128, 128, 192, 320, 577, 1024};
  const std::uint32_t choice = bytes.below(8);
  if (choice == 0) return custom_pattern(bytes);
  const int ray_count = bytes.once_in(2) ? 1 + static_cast<int>(bytes.below(140)) : bytes.pick(kCounts);
  const PatternKind kind = bytes.pick(kKinds);
  // Relaxing many points takes a while.
  const bool is_slow = ray_count > 192 && (kind == PatternKind::lloyd || kind == PatternKind::paper);
  return kept_pattern(is_slow ? PatternKind::fibonacci : kind, ray_count,
                      is_slow ? kFalloffs[0] : bytes.pick(kFalloffs));
}

class QueryCaseDecoder {
 public:
  explicit QueryCaseDecoder(ByteSource& bytes)
      : bytes_(bytes), is_wild_(bytes.once_in(8)), soup_(make_soup(bytes, is_wild_)) {}

  QueryCase decode() {
    const BuildOptions build{.spatial_splits = !bytes_.once_in(3)};
    NamedPattern pattern = decode_pattern(bytes_);
    const RayOptions options = decode_options();
    const NodeMasks node_masks = bytes_.once_in(2) ? NodeMasks::bounding_sphere : NodeMasks::box_outline;
    const std::uint64_t first_index = bytes_.next_byte();
    // Brute force over all triangles is what takes the time.
    const std::size_t tests =
        (soup_.mesh.triangles.size() + 20) * static_cast<std::size_t>(pattern.pattern.ray_count());
    const std::size_t receiver_count = std::clamp<std::size_t>(100'000 / tests, 2, 12);
    std::vector<Receiver> receivers;
    for (std::size_t i = 0; i < receiver_count; ++i) receivers.push_back(decode_receiver());
    const float level_end = decode_level_end(options.radius, receivers);
    // An infinite radius makes rays of all lengths the same, which a table cannot.
    const std::span<const float> lengths = pattern.pattern.lengths();
    const bool are_equal = std::equal(lengths.begin() + 1, lengths.end(), lengths.begin());
    if (std::isinf(options.radius) && !are_equal) pattern.table.reset();
    return {is_wild_,
            std::move(soup_.mesh),
            build,
            pattern.pattern,
            std::move(pattern.name),
            pattern.table,
            options,
            node_masks,
            std::move(receivers),
            first_index,
            level_end};
  }

 private:
  RayOptions decode_options() {
    constexpr float kRotations[] = {0, 1, 0.25f};
    constexpr float kTilts[] = {0, 0, 0.1f, 1.5f};
    constexpr float kOffsets[] = {16, 16, 0, 1, 1000};
    RayOptions options;
    options.radius = decode_radius();
    options.sidedness = bytes_.once_in(3) ? Sidedness::one_sided : Sidedness::two_sided;
    options.jitter = {.rotation = bytes_.pick(kRotations), .tilt = bytes_.pick(kTilts)};
    options.seed = bytes_.next_byte();
    options.surface_offset = bytes_.pick(kOffsets);
    if (bytes_.once_in(4)) options.min_distance = decode_min_distance(options.radius);
    return options;
  }

  // Less than the radius, mostly where the soup is.
  float decode_min_distance(float radius) { return std::min(radius, soup_.placement.scale) * 0.999f * bytes_.share(); }

  // The second level knows nothing of primitives that are excluded.
  float decode_level_end(float radius, std::vector<Receiver>& receivers) {
    if (!bytes_.once_in(2)) return 0;
    for (Receiver& receiver : receivers) receiver.excluded_primitive = kNoPrimitive;
    const float most = std::isinf(radius) ? 3 * soup_.placement.scale : radius;
    return most * 1.1f * bytes_.share();
  }

  // From a thousandth of the soup to far beyond it, and without end.
  float decode_radius() {
    if (bytes_.once_in(6)) return std::numeric_limits<float>::infinity();
    if (bytes_.once_in(6)) return soup_.placement.scale * std::pow(10.0f, 6 * bytes_.share());
    const float radius = soup_.placement.scale * std::pow(10.0f, 5 * bytes_.share() - 3);
    return is_wild_ ? std::pow(10.0f, 18 * bytes_.coordinate()) : radius;
  }

  glm::vec3 direction() {
    const glm::vec3 v = bytes_.point();
    if (!bytes_.once_in(3)) return glm::normalize(v);
    glm::vec3 axis(0);
    axis[static_cast<int>(bytes_.below(3))] = v.x < 0 ? -1.0f : 1.0f;
    return axis;
  }

  glm::vec3 direction_or_worse() {
    constexpr float kLengths[] = {1, 1e-30f, 1e30f, 0, std::numeric_limits<float>::quiet_NaN()};
    if (bytes_.once_in(16)) return raw_point(bytes_);
    const glm::vec3 v = direction();
    return bytes_.once_in(16) ? v * bytes_.pick(kLengths) : v;
  }

  Receiver decode_receiver() {
    Receiver receiver;
    receiver.normal = direction_or_worse();
    const std::size_t triangle_count = soup_.mesh.triangles.size();
    if (triangle_count == 0 || bytes_.once_in(3)) {
      receiver.position = soup_.placement.place(soup_point(bytes_, soup_.on_grid));
    } else {
      put_on_triangle(receiver, bytes_.below(triangle_count));
    }
    if (bytes_.once_in(8)) put_far_outside(receiver);
    if (is_wild_ && bytes_.once_in(4)) receiver.position = raw_point(bytes_);
    if (bytes_.once_in(4)) receiver.geometric_normal = receiver.normal + direction_or_worse();
    if (bytes_.once_in(8)) receiver.excluded_primitive = bytes_.below(triangle_count + 1);
    return receiver;
  }

  // Up to 10,000 times as far away as the soup is large, mostly looking back at it.
  void put_far_outside(Receiver& receiver) {
    const glm::vec3 from = direction();
    const float distance = soup_.placement.scale * std::pow(10.0f, 4 * bytes_.share());
    receiver.position = soup_.placement.place(glm::vec3(0)) + distance * from;
    if (!bytes_.once_in(4)) receiver.normal = -from;
  }

  // On a corner, an edge or the face; mostly with the triangle's normal.
  void put_on_triangle(Receiver& receiver, std::uint32_t triangle) {
    const glm::uvec3& t = soup_.mesh.triangles[triangle];
    const glm::vec3 a = soup_.mesh.positions[t.x], b = soup_.mesh.positions[t.y], c = soup_.mesh.positions[t.z];
    const std::uint32_t part = bytes_.below(4);
    const float u = part == 0 ? 0 : bytes_.share(), v = part <= 1 ? 0 : bytes_.share() * (1 - u);
    receiver.position = a + u * (b - a) + v * (c - a);
    if (bytes_.once_in(3)) return;
    const glm::dvec3 normal = bvh::area_vector(a, b, c);
    const glm::dvec3 unit = glm::normalize(normal);
    receiver.normal = glm::vec3(bytes_.once_in(2) ? -unit : unit);
    if (bytes_.once_in(4)) receiver.excluded_primitive = triangle;
  }

  ByteSource& bytes_;
  bool is_wild_;
  Soup soup_;
};

}  // namespace

QueryCase decode_query_case(std::span<const std::uint8_t> bytes) {
  ByteSource source(bytes);
  return QueryCaseDecoder(source).decode();
}

}  // namespace lkao::tests
