// builtin:city, 12 x 12 blocks of buildings on a plane: x and z from -750 to 750, the streets at y = 0.
#include <algorithm>

#include "scene/builtin.h"
#include "scene/shapes.h"

namespace lkao::scene {

namespace {

constexpr int kBlockCount = 12;  // a side
constexpr double kPitch = 125;   // from block to block
constexpr double kBlock = 98;    // side of a block; the rest is street
constexpr double kPavement = 0.8;
constexpr double kStorey = 9;
constexpr double kSink = 0.3;

// A piece of ground, with its middle on top of the pavement.
struct Lot {
  glm::dvec3 center;
  double side;
};

// A rectangular body: its base's middle, and its extent.
struct Body {
  glm::dvec3 base;
  glm::dvec3 size;
};

enum class Windows { single, bands, pillars };

// Lines of a wall in one direction: part_count recesses with frames between them.
std::vector<double> wall_lines(double length, int part_count, double frame_share) {
  std::vector<double> lines;
  const double pitch = length / part_count;
  const double frame = frame_share * pitch;
  lines.push_back(-0.5 * length);
  for (int i = 0; i < part_count; ++i) {
    const double start = -0.5 * length + i * pitch;
    lines.insert(lines.end(), {start + frame, start + pitch - frame});
  }
  lines.push_back(0.5 * length);
  return lines;
}

// Four walls with recessed windows.
void add_walls(Mesh& mesh, const Body& body, Windows windows, int storey_count, Random& random) {
  const double depth = random.uniform(0.7, 1.4);
  const double frame = random.uniform(0.12, 0.22);
  for (int side = 0; side < 4; ++side) {
    const bool along_x = side % 2 == 0;
    const double length = along_x ? body.size.x : body.size.z;
    const double off = 0.5 * (along_x ? body.size.z : body.size.x);
    const int column_count = windows == Windows::bands ? 1 : std::max(2, static_cast<int>(length / 12));
    const std::vector<double> us = wall_lines(length, column_count, windows == Windows::bands ? 0.04 : frame);
    const std::vector<double> vs = wall_lines(body.size.y, windows == Windows::pillars ? 1 : storey_count, frame);
    const glm::dvec2 out = unit_circle(0.25 * side);
    const auto height_at = [depth](std::size_t i, std::size_t j) { return i % 2 == 1 && j % 2 == 1 ? -depth : 0.0; };
    add_relief(mesh, us, vs, height_at, [&](double u, double v, double h) {
      const double outwards = off + h;
      return body.base + glm::dvec3(out.x * u + out.y * outwards, v + 0.5 * body.size.y, -out.y * u + out.x * outwards);
    });
  }
}

// A flat roof inside a parapet.
void add_roof(Mesh& mesh, const Body& body, double parapet) {
  const glm::dvec3 half = 0.5 * body.size;
  const double us[] = {-half.x, -half.x + 1, half.x - 1, half.x};
  const double vs[] = {-half.z, -half.z + 1, half.z - 1, half.z};
  add_relief(
      mesh, us, vs, [&](std::size_t i, std::size_t j) { return i == 1 && j == 1 ? -parapet : 0.0; },
      [&](double u, double v, double h) { return body.base + glm::dvec3(u, body.size.y + h, -v); });
}

void add_ledge(Mesh& mesh, const Body& body, double y, double thickness, double off) {
  const glm::dvec3 reach(0.5 * body.size.x + off, 0, 0.5 * body.size.z + off);
  const glm::dvec3 middle = body.base + glm::dvec3(0, y, 0);
  add_box(mesh, middle - reach, middle + reach + glm::dvec3(0, thickness, 0));
}

void add_tank(Mesh& mesh, const glm::dvec3& base, double radius) {
  for (int leg = 0; leg < 4; ++leg) {
    const glm::dvec2 p = 0.7 * radius * unit_circle(0.25 * leg + 0.125);
    const glm::dvec3 foot = base + glm::dvec3(p.x, 0, p.y);
    add_box(mesh, foot - glm::dvec3(0.2, kSink, 0.2), foot + glm::dvec3(0.2, 2.1, 0.2));
  }
  const glm::dvec2 profile[] = {{0, 2}, {radius, 2}, {radius, 6}, {1.08 * radius, 6}, {0, 8}};
  add_revolved(mesh, base, profile, 16);
}

// Machines on a flat roof.
void add_roof_things(Mesh& mesh, const Body& body, double parapet, Random& random) {
  const glm::dvec3 roof = body.base + glm::dvec3(0, body.size.y - parapet, 0);
  for (int quadrant = 0; quadrant < 4; ++quadrant) {
    const glm::dvec3 place =
        roof + glm::dvec3((quadrant % 2 - 0.5) * 0.4 * body.size.x, 0, (quadrant / 2 - 0.5) * 0.4 * body.size.z);
    const double half = random.uniform(0.06, 0.13) * body.size.x;
    const int kind = random.below(4);
    if (kind == 0) add_tank(mesh, place, half);
    if (kind == 1 || kind == 2) {
      const double height = random.uniform(1.5, 5);
      add_box(mesh, place - glm::dvec3(half, kSink, 0.7 * half), place + glm::dvec3(half, height, 0.7 * half));
    }
  }
}

void add_office(Mesh& mesh, const Lot& lot, int storey_count, Windows windows, Random& random) {
  const Body body{
      lot.center - glm::dvec3(0, kSink, 0),
      {lot.side * random.uniform(0.72, 0.94), storey_count * kStorey, lot.side * random.uniform(0.72, 0.94)}};
  const double parapet = random.uniform(0.8, 2.0);
  add_walls(mesh, body, windows, storey_count, random);
  add_roof(mesh, body, parapet);
  add_roof_things(mesh, body, parapet, random);
  add_ledge(mesh, body, kStorey - 0.5, 0.9, 0.8);
  if (storey_count > 4) add_ledge(mesh, body, (storey_count - 1) * kStorey - 0.4, 0.7, 0.6);
}

// Bodies one on another, each narrower than that below.
void add_stepped_tower(Mesh& mesh, const Lot& lot, int storey_count, Random& random) {
  double y = -kSink;
  double side = 0.92 * lot.side;
  const Windows windows = random.below(2) == 0 ? Windows::single : Windows::pillars;
  for (int stage = 0; stage < 3; ++stage) {
    const int storeys = stage == 2 ? storey_count - 2 * (storey_count / 3) : storey_count / 3;
    const Body body{lot.center + glm::dvec3(0, y, 0), {side, storeys * kStorey, side}};
    add_walls(mesh, body, windows, storeys, random);
    add_roof(mesh, body, 1.2);
    if (stage == 2) add_tank(mesh, body.base + glm::dvec3(0, body.size.y - 1.2, 0), 0.12 * side);
    y += body.size.y - 1.2 - kSink;
    side *= random.uniform(0.66, 0.8);
  }
}

void add_round_tower(Mesh& mesh, const Lot& lot, int storey_count) {
  const double radius = 0.42 * lot.side;
  std::vector<glm::dvec2> profile = {{radius, -kSink}};
  for (int storey = 0; storey < storey_count; ++storey) {
    const double y = storey * kStorey;
    profile.insert(profile.end(),
                   {{radius, y + 2.2}, {radius - 1.1, y + 2.2}, {radius - 1.1, y + 7.6}, {radius, y + 7.6}});
  }
  const double top = storey_count * kStorey;
  profile.insert(profile.end(), {{radius, top},
                                 {radius + 0.8, top},
                                 {radius + 0.8, top + 1.5},
                                 {radius - 1, top + 1.5},
                                 {radius - 1, top},
                                 {0.3 * radius, top + 0.1},
                                 {0, top + 0.45 * radius}});
  add_revolved(mesh, lot.center, profile, 28);
}

// A house with a gable roof that overhangs, windows, a door and a chimney.
void add_house(Mesh& mesh, const Lot& lot, Random& random) {
  const Body body{lot.center - glm::dvec3(0, kSink, 0),
                  {lot.side * random.uniform(0.6, 0.72), random.uniform(11, 17), lot.side * random.uniform(0.7, 0.85)}};
  add_walls(mesh, body, Windows::single, 2, random);
  const double eaves = body.size.y - 1;
  const double rise = body.size.x * random.uniform(0.35, 0.55);
  const double x = 0.5 * body.size.x + 1.6;
  const double z = 0.5 * body.size.z + 1.2;
  const glm::dvec2 section[] = {{-x, eaves - 0.6}, {x, eaves - 0.6}, {x, eaves}, {0, eaves + rise}, {-x, eaves}};
  const Station path[] = {{body.base + glm::dvec3(0, 0, z), {1, 0, 0}, {0, 1, 0}},
                          {body.base - glm::dvec3(0, 0, z), {1, 0, 0}, {0, 1, 0}}};
  add_swept(mesh, path, section);
  const glm::dvec3 chimney = body.base + glm::dvec3(0.22 * body.size.x, eaves, 0.2 * body.size.z);
  add_box(mesh, chimney - glm::dvec3(1, 0, 1), chimney + glm::dvec3(1, rise + 2.5, 1));
  const glm::dvec3 step = body.base + glm::dvec3(0, 0, 0.5 * body.size.z + 1);
  add_box(mesh, step - glm::dvec3(2, 0, 1.4), step + glm::dvec3(2, 0.9, 1.4));
}

void add_tree(Mesh& mesh, const glm::dvec3& foot, Random& random) {
  const double height = random.uniform(4, 6.5);
  const glm::dvec2 trunk[] = {{0.75, -kSink}, {0.5, 0.8}, {0.35, height + 1}, {0, height + 2}};
  add_revolved(mesh, foot, trunk, 6);
  const double radius = random.uniform(2.4, 3.6);
  add_sphere(mesh, foot + glm::dvec3(0, height + 0.7 * radius, 0), radius, 8, 5);
  const glm::dvec2 p = 0.7 * radius * unit_circle(random.uniform());
  add_sphere(mesh, foot + glm::dvec3(p.x, height + 1.5 * radius, p.y), 0.7 * radius, 8, 5);
}

void add_lamp(Mesh& mesh, const glm::dvec3& foot, const glm::dvec2& to_street) {
  const glm::dvec2 pole[] = {{0.35, -kSink}, {0.3, 0.6}, {0.16, 0.8}, {0.12, 8.5}, {0, 8.7}};
  add_revolved(mesh, foot, pole, 6);
  const glm::dvec3 head = foot + glm::dvec3(1.2 * to_street.x, 8.4, 1.2 * to_street.y);
  const glm::dvec3 half(0.25 + 1.1 * to_street.x * to_street.x, 0.12, 0.25 + 1.1 * to_street.y * to_street.y);
  add_box(mesh, head - half, head + half);
}

// Trees and lamps in turns along the four kerbs.
void add_kerb(Mesh& mesh, const glm::dvec3& block, Random& random) {
  constexpr int kPlaceCount = 4;
  for (int side = 0; side < 4; ++side) {
    const glm::dvec2 out = unit_circle(0.25 * side);
    for (int i = 0; i < kPlaceCount; ++i) {
      const double along = kBlock * ((i + 0.5) / kPlaceCount - 0.5);
      const double off = 0.5 * kBlock - 1.6;
      const glm::dvec3 foot = block + glm::dvec3(out.x * off - out.y * along, 0, out.y * off + out.x * along);
      if (i % 2 == 0) {
        add_lamp(mesh, foot, out);
      } else if (random.below(3) != 0) {
        add_tree(mesh, foot, random);
      }
    }
  }
}

void add_park(Mesh& mesh, const Lot& lot, Random& random) {
  const glm::dvec2 pond[] = {
      {0.2 * lot.side, -kSink}, {0.2 * lot.side, 1}, {0.19 * lot.side, 1}, {0.18 * lot.side, 0.2}, {0, 0.2}};
  add_revolved(mesh, lot.center, pond, 40);
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 9; ++j) {
      // Braces: their order of evaluation is fixed, that of arguments is not.
      const glm::dvec2 p{0.095 * lot.side * (i - 4) + random.uniform(-2, 2),
                         0.095 * lot.side * (j - 4) + random.uniform(-2, 2)};
      const double distance2 = p.x * p.x + p.y * p.y;
      if (distance2 > 0.07 * lot.side * lot.side && random.below(4) != 0) {
        add_tree(mesh, lot.center + glm::dvec3(p.x, 0, p.y), random);
      }
    }
  }
}

void add_building(Mesh& mesh, const Lot& lot, int storey_count, Random& random) {
  const int kind = random.below(10);
  if (kind < 5) return add_office(mesh, lot, storey_count, Windows::single, random);
  if (kind < 7) return add_office(mesh, lot, storey_count, Windows::bands, random);
  if (kind < 8) return add_office(mesh, lot, storey_count, Windows::pillars, random);
  if (kind < 9) return add_stepped_tower(mesh, lot, storey_count + 3, random);
  add_round_tower(mesh, lot, storey_count);
}

// lot_count x lot_count pieces of a block, inside the kerb.
std::vector<Lot> divide(const glm::dvec3& block, int lot_count) {
  const double side = (kBlock - 9) / lot_count;
  std::vector<Lot> lots;
  for (int i = 0; i < lot_count * lot_count; ++i) {
    const glm::dvec2 cell(i % lot_count - 0.5 * (lot_count - 1), i / lot_count - 0.5 * (lot_count - 1));
    lots.push_back({block + side * glm::dvec3(cell.x, 0, cell.y), side - 2});
  }
  return lots;
}

void add_block(Mesh& mesh, const glm::dvec3& center, double distance, Random& random) {
  const glm::dvec3 half(0.5 * kBlock, 0, 0.5 * kBlock);
  add_box(mesh, center - half - glm::dvec3(0, kSink, 0), center + half + glm::dvec3(0, kPavement, 0));
  const glm::dvec3 ground = center + glm::dvec3(0, kPavement, 0);
  add_kerb(mesh, ground, random);

  // Towers in the middle of the city, houses at its edge.
  const int kind = random.below(100);
  if (kind < 8) return add_park(mesh, divide(ground, 1)[0], random);
  if (distance < 0.3 && kind < 40) return add_stepped_tower(mesh, divide(ground, 1)[0], 14 + random.below(6), random);
  if (distance > 0.55 && kind < 65) {
    for (const Lot& lot : divide(ground, 3)) {
      if (random.below(8) != 0) add_house(mesh, lot, random);
    }
    return;
  }
  const int tallest = static_cast<int>(13 - 9 * distance);
  for (const Lot& lot : divide(ground, 2)) add_building(mesh, lot, 3 + random.below(tallest), random);
}

}  // namespace

Mesh make_city() {
  Mesh mesh;
  constexpr double kHalf = 0.5 * kBlockCount * kPitch;
  add_quad(mesh, {-kHalf, 0, kHalf}, {kHalf, 0, kHalf}, {kHalf, 0, -kHalf}, {-kHalf, 0, -kHalf});
  Random random(879);
  for (int i = 0; i < kBlockCount * kBlockCount; ++i) {
    const glm::dvec3 center((i % kBlockCount + 0.5) * kPitch - kHalf, 0, (i / kBlockCount + 0.5) * kPitch - kHalf);
    const double distance = (center.x * center.x + center.z * center.z) / (2 * kHalf * kHalf);
    add_block(mesh, center, distance, random);
  }
  return mesh;
}

}  // namespace lkao::scene
