// builtin:atrium, a vaulted hall. It looks along +x: a nave under a coffered barrel vault between two rows of columns
// that carry arches; aisles with niches in their walls; at the end steps and an apse. x from -15 to 15, z from -7 to 7,
// the floor at y = 0. A room without openings. Parts that touch overlap a little, so that no two faces lie in one
// plane.
#include <algorithm>
#include <array>

#include "scene/atrium_furniture.h"
#include "scene/builtin.h"
#include "scene/shapes.h"

namespace lkao::scene {

namespace {

constexpr double kHalfLength = 15;
constexpr double kHalfWidth = 7;
constexpr int kColumnCount = 7;  // a row
constexpr double kBay = 3.75;    // from column to column
constexpr double kRow = 3.6;     // of the columns' axes, off the middle
constexpr double kWallHalfDepth = 0.36;
constexpr double kArcadeSpring = 4.3;  // where the arches begin, on the columns
constexpr double kArcadeRadius = 1.42;
constexpr double kVaultSpring = 7.6;
constexpr double kVaultRadius = 3.42;
constexpr double kAisleCeiling = 6.5;
constexpr double kWallHeight = 11.6;
constexpr double kPlatform = 0.9;  // height of the floor behind the steps
constexpr double kFoot = -0.1;     // of the walls, below the floor's grooves

double column_x(int column) { return (column - (kColumnCount - 1) / 2) * kBay; }

// A moulding along x or z: stations for add_swept, the profile's x pointing away from the wall, its y up.
std::array<Station, 2> straight(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& off_wall) {
  return {Station{from, off_wall, {0, 1, 0}}, Station{to, off_wall, {0, 1, 0}}};
}

// The rounded grooves of a shaft.
double flute(double turns) {
  constexpr int kFluteCount = 20;
  const double phase = kFluteCount * turns - static_cast<int>(kFluteCount * turns);
  const double x = 2 * phase - 1;
  const double rim = x < 0 ? 1 + x : 1 - x;
  return rim < 0.16 ? 1.0 : 1.0 - 0.075 * (1 - x * x / 0.7056);
}

void add_column(Mesh& mesh, double x, double z, double floor) {
  const double height = kArcadeSpring - floor;
  const double capital = height - 0.75;
  const glm::dvec3 base(x, floor, z);
  add_box(mesh, base + glm::dvec3(-0.58, -kAtriumSink, -0.58), base + glm::dvec3(0.58, 0.22, 0.58));
  // Base: two tori with a hollow between.
  std::vector<glm::dvec2> profile = {{0.5, 0.2}};
  add_bulge(profile, 0.46, 0.22, 0.36, 8);
  profile.insert(profile.end(), {{0.45, 0.38}, {0.425, 0.42}, {0.43, 0.46}});
  add_bulge(profile, 0.42, 0.47, 0.55, 6);
  profile.emplace_back(0.3, 0.6);
  add_revolved(mesh, base, profile, 48);
  // Shaft: swells a little, thinner at the top.
  profile.clear();
  constexpr int kShaftSteps = 6;
  for (int i = 0; i <= kShaftSteps; ++i) {
    const double t = static_cast<double>(i) / kShaftSteps;
    profile.emplace_back(0.395 - 0.02 * t - 0.05 * t * t, 0.54 + t * (capital - 0.54));
  }
  add_revolved(mesh, base, profile, 120, flute);
  // Capital: a ring, a bell, a cushion, and a square slab in two steps.
  profile = {{0.3, capital - 0.06}};
  add_bulge(profile, 0.34, capital - 0.04, capital + 0.04, 6);
  for (int i = 0; i <= 8; ++i) {
    const double t = i / 8.0;
    profile.emplace_back(0.335 + 0.06 * t + 0.1 * t * t * t, capital + 0.05 + 0.3 * t);
  }
  add_bulge(profile, 0.47, capital + 0.36, capital + 0.5, 8);
  profile.emplace_back(0.3, capital + 0.52);
  add_revolved(mesh, base, profile, 48);
  add_box(mesh, base + glm::dvec3(-0.56, capital + 0.49, -0.56), base + glm::dvec3(0.56, capital + 0.62, 0.56));
  add_box(mesh, base + glm::dvec3(-0.63, capital + 0.6, -0.63), base + glm::dvec3(0.63, capital + 0.77, 0.63));
}

// A ring of rectangular section around an arch's opening, standing off the wall, with a thinner ring on it.
void add_archivolt(Mesh& mesh, const ArchedOpening& opening, double inner, double outer, double off,
                   const Placement& place) {
  constexpr int kStepCount = 32;
  const glm::dvec3 origin = place(0, 0, 0);
  const glm::dvec3 u = place(1, 0, 0) - origin;
  const glm::dvec3 v = place(0, 1, 0) - origin;
  const glm::dvec3 normal = place(0, 0, 1) - origin;
  std::vector<Station> path;
  for (int i = 0; i <= kStepCount; ++i) {
    const glm::dvec2 p = unit_circle(0.5 * i / kStepCount);
    path.push_back({place(opening.center, opening.spring, 0), p.x * u + p.y * v, normal});
  }
  const glm::dvec2 section[] = {{opening.radius + inner, -0.05 - 0.1 * off},
                                {opening.radius + inner, off},
                                {opening.radius + outer, off},
                                {opening.radius + outer, -0.05 - 0.1 * off}};
  add_swept(mesh, path, section);
}

// The wall that the columns carry: an arch a bay, both faces and the soffits, with mouldings. It stands on the columns'
// slabs, which hide that it is hollow.
void add_arcade(Mesh& mesh, double z) {
  constexpr int kSegments = 40;
  const double direction = z > 0 ? -1 : 1;  // towards the nave
  for (int bay = 0; bay <= kColumnCount; ++bay) {
    const double center = column_x(0) + (bay - 0.5) * kBay;
    const ArchedOpening opening{center, kArcadeRadius, kArcadeSpring, kArcadeSpring};
    for (double side : {direction, -direction}) {
      const Placement place = [&](double u, double v, double h) {
        return glm::dvec3(side > 0 ? u : -u, v, z + side * (kWallHalfDepth + h));
      };
      const double middle = side > 0 ? center : -center;
      const ArchedOpening seen{middle, opening.radius, opening.sill, opening.spring};
      add_arched_panel(mesh, {middle - 0.5 * kBay, kArcadeSpring}, {middle + 0.5 * kBay, kVaultSpring + 0.1}, seen,
                       kSegments, place);
      add_archivolt(mesh, seen, 0.03, 0.26, 0.06, place);
      add_archivolt(mesh, seen, 0.16, 0.21, 0.1, place);
    }
    const Placement through = [&](double u, double v, double h) { return glm::dvec3(u, v, z + kWallHalfDepth + h); };
    add_soffit(mesh, opening, 2 * kWallHalfDepth, kSegments, through);
  }
  // Two ledges on the nave's side: a thin one over the arches, and the cornice on which the vault stands.
  const double face = z + direction * (kWallHalfDepth - kAtriumSink);
  const glm::dvec3 off(0, 0, direction);
  const std::vector<glm::dvec2> thin = {{0, 0}, {0.08, 0.02}, {0.1, 0.1}, {0.16, 0.13}, {0.16, 0.2}, {0, 0.24}};
  const std::vector<glm::dvec2> cornice = {{0, -0.5},    {0.1, -0.46}, {0.1, -0.36},  {0.18, -0.33}, {0.22, -0.25},
                                           {0.32, -0.2}, {0.32, -0.1}, {0.42, -0.06}, {0.42, 0.04},  {0, 0.08}};
  const auto add_ledge = [&](std::vector<glm::dvec2> profile, double y) {
    // Sweeping along +x keeps fronts outside for off = -z; the other row is swept the other way.
    const double end = direction > 0 ? -kHalfLength - kAtriumSink : kHalfLength + kAtriumSink;
    add_swept(mesh, straight({end, y, face}, {-end, y, face}, off), profile);
  };
  add_ledge(thin, 6.2);
  add_ledge(cornice, kVaultSpring);
  // Small blocks under the cornice.
  for (int i = 0; i < 80; ++i) {
    const double x = -kHalfLength + 0.1 + 0.375 * i;
    const double z0 = z + direction * (kWallHalfDepth - 0.05);
    const double z1 = z + direction * (kWallHalfDepth + 0.2);
    add_box(mesh, {x, kVaultSpring - 0.36, z0 < z1 ? z0 : z1}, {x + 0.16, kVaultSpring - 0.19, z0 < z1 ? z1 : z0});
  }
}

// Lines of a coffered surface: cells of the given pitch; across a cell a frame, a ledge, the panel, and so on back.
std::vector<double> coffer_lines(double from, double to, int coffer_count, double frame, double ledge,
                                 int panel_parts) {
  std::vector<double> lines;
  const double pitch = (to - from) / coffer_count;
  for (int i = 0; i < coffer_count; ++i) {
    const double start = from + i * pitch;
    const double inner_start = start + frame + ledge;
    const double inner_end = start + pitch - frame - ledge;
    lines.insert(lines.end(), {start, start + frame});
    for (int part = 0; part <= panel_parts; ++part) {
      lines.push_back(inner_start + part * (inner_end - inner_start) / panel_parts);
    }
    lines.push_back(start + pitch - frame);
  }
  lines.push_back(to);
  return lines;
}

// 0 on the frame, 1 on the ledge, 2 on the panel.
int coffer_level(std::size_t line, int panel_parts) {
  const auto count = static_cast<std::size_t>(panel_parts) + 4;
  const std::size_t place = line % count;
  const std::size_t from_end = count - 1 - place;
  return static_cast<int>(std::min<std::size_t>({place, from_end, 2}));
}

void add_vault(Mesh& mesh) {
  // v runs around the vault; three parts of every panel follow the curve.
  const std::vector<double> us = coffer_lines(-kHalfLength, kHalfLength, 24, 0.16, 0.09, 1);
  const std::vector<double> vs = coffer_lines(0, 0.5, 9, 0.0075, 0.0045, 4);
  const auto height_at = [](std::size_t i, std::size_t j) {
    return -0.11 * std::min(coffer_level(i, 1), coffer_level(j, 4));
  };
  add_relief(mesh, us, vs, height_at, [](double u, double v, double h) {
    const glm::dvec2 p = (kVaultRadius - h) * unit_circle(v);
    return glm::dvec3(u, kVaultSpring + p.y, p.x);
  });
  // Roses in the coffers.
  for (int i = 0; i < 24; ++i) {
    for (int j = 0; j < 9; ++j) {
      const glm::dvec2 p = (kVaultRadius + 0.2) * unit_circle((j + 0.5) / 18);
      add_sphere(mesh, {-kHalfLength + 1.25 * (i + 0.5), kVaultSpring + p.y, p.x}, 0.1, 12, 8);
    }
  }
}

// Ribs under the vault, one over each column, with a thinner band on each.
void add_ribs(Mesh& mesh) {
  constexpr int kStepCount = 48;
  for (int column = 0; column < kColumnCount; ++column) {
    std::vector<Station> path;
    for (int i = 0; i <= kStepCount; ++i) {
      const glm::dvec2 p = unit_circle(0.5 * i / kStepCount);
      path.push_back({{column_x(column), kVaultSpring, 0}, {1, 0, 0}, {0, p.y, p.x}});
    }
    const glm::dvec2 rib[] = {{-0.24, 3.6}, {0.24, 3.6}, {0.24, 3.22}, {0.2, 3.18}, {-0.2, 3.18}, {-0.24, 3.22}};
    const glm::dvec2 band[] = {{-0.1, 3.3}, {0.1, 3.3}, {0.1, 3.12}, {-0.1, 3.12}};
    add_swept(mesh, path, rib);
    add_swept(mesh, path, band);
  }
}

void add_aisle_ceiling(Mesh& mesh, double z_sign) {
  const std::vector<double> us = coffer_lines(-kHalfLength, kHalfLength, 24, 0.15, 0.1, 1);
  const std::vector<double> vs = coffer_lines(kRow, kHalfWidth, 3, 0.12, 0.1, 1);
  const auto height_at = [](std::size_t i, std::size_t j) {
    return -0.13 * std::min(coffer_level(i, 1), coffer_level(j, 1));
  };
  // Front down: u x v must point along -y.
  add_relief(mesh, us, vs, height_at,
             [z_sign](double u, double v, double h) { return glm::dvec3(z_sign * u, kAisleCeiling - h, z_sign * v); });
}

// An outer wall: a niche a bay, a ledge over them, and above it a face of two triangles.
void add_outer_wall(Mesh& mesh, double z_sign) {
  constexpr int kSegments = 28;
  constexpr double kLedge = 4.45;
  const Placement place = [z_sign](double u, double v, double h) {
    return glm::dvec3(-z_sign * u, v, z_sign * (kHalfWidth - h));
  };
  for (int bay = 0; bay < 8; ++bay) {
    const double center = -kHalfLength + (bay + 0.5) * kBay;
    const ArchedOpening opening{center, 0.85, 1.05, 2.85};
    add_arched_panel(mesh, {center - 0.5 * kBay, kFoot}, {center + 0.5 * kBay, kLedge}, opening, kSegments, place);
    add_niche(mesh, opening, kSegments, place);
    add_archivolt(mesh, opening, 0.02, 0.17, 0.07, place);
    const glm::dvec3 left = place(center - 1.1, 0, 0);
    const glm::dvec3 right = place(center + 1.1, 0, 0);
    const double x0 = left.x < right.x ? left.x : right.x;
    const double z0 = z_sign * kHalfWidth;
    add_box(mesh, {x0, 0.86, z_sign > 0 ? z0 - 0.2 : z0 - 0.02}, {x0 + 2.2, 1.03, z_sign > 0 ? z0 + 0.02 : z0 + 0.2});
    if (bay % 2 == 0) {
      add_urn(mesh, place(center, opening.sill, -0.32), 1.35);
    } else {
      add_pedestal(mesh, place(center, opening.sill, -0.34), 0.24, 0.5);
      add_sphere(mesh, place(center, opening.sill + 0.86, -0.34), 0.37, 40, 24);
    }
  }
  add_quad(mesh, place(-kHalfLength, kLedge, 0), place(kHalfLength, kLedge, 0), place(kHalfLength, kWallHeight, 0),
           place(-kHalfLength, kWallHeight, 0));
  const std::vector<glm::dvec2> ledge = {{0, -0.14}, {0.1, -0.1}, {0.12, 0}, {0.2, 0.04}, {0.2, 0.13}, {0, 0.17}};
  const std::vector<glm::dvec2> skirting = {
      {0, -kAtriumSink}, {0.12, -kAtriumSink}, {0.12, 0.3}, {0.05, 0.38}, {0, 0.4}};
  const glm::dvec3 off(0, 0, -z_sign);
  const double z = z_sign * (kHalfWidth + kAtriumSink);
  const double end = z_sign * (kHalfLength + kAtriumSink);
  add_swept(mesh, straight({end, kLedge, z}, {-end, kLedge, z}, off), ledge);
  add_swept(mesh, straight({end, 0, z}, {-end, 0, z}, off), skirting);
}

void add_end_walls(Mesh& mesh) {
  // Behind the viewer: two triangles.
  add_quad(mesh, {-kHalfLength, kFoot, kHalfWidth}, {-kHalfLength, kFoot, -kHalfWidth},
           {-kHalfLength, kWallHeight, -kHalfWidth}, {-kHalfLength, kWallHeight, kHalfWidth});
  // Ahead: the apse, a niche as high as the nave, with a ring around its arch.
  const Placement place = [](double u, double v, double h) { return glm::dvec3(kHalfLength - h, v, u); };
  const ArchedOpening apse{0, 2.45, kPlatform - kAtriumSink, 5.2};
  add_arched_panel(mesh, {-kHalfWidth, kFoot}, {kHalfWidth, kWallHeight}, apse, 64, place);
  add_niche(mesh, apse, 64, place);
  add_archivolt(mesh, apse, 0.04, 0.34, 0.1, place);
  add_archivolt(mesh, apse, 0.2, 0.28, 0.15, place);
  for (double z : {-2.72, 2.72}) {
    add_box(mesh, {kHalfLength - 0.1, kPlatform - kAtriumSink, z - 0.16}, {kHalfLength + 0.05, 5.25, z + 0.16});
    add_box(mesh, {kHalfLength - 0.17, 5.0, z - 0.22}, {kHalfLength + 0.05, 5.21, z + 0.22});
  }
  add_pedestal(mesh, {kHalfLength + 0.5, kPlatform, 0}, 0.55, 1.2);
  add_urn(mesh, {kHalfLength + 0.5, kPlatform + 1.2, 0}, 2.2);
}

// Tiles with grooves between them, each at a height of its own by a hair, on the floor before the steps.
void add_floor(Mesh& mesh) {
  constexpr double kTile = 1.25;
  constexpr int kTileCountX = 24;
  constexpr int kTileCountZ = 11;
  constexpr double kHalfGroove = 0.028;
  constexpr double kGrooveDepth = 0.05;
  std::vector<double> us;
  std::vector<double> vs;
  const auto add_tile_lines = [](std::vector<double>& lines, double first, int tile_count) {
    for (int i = 0; i < tile_count; ++i) {
      lines.insert(lines.end(), {first + i * kTile + kHalfGroove, first + (i + 1) * kTile - kHalfGroove});
    }
  };
  add_tile_lines(us, -kHalfLength, kTileCountX);
  add_tile_lines(vs, -0.5 * kTileCountZ * kTile, kTileCountZ);
  us.front() = -kHalfLength;
  us.back() = kHalfLength;
  vs.insert(vs.begin(), -kHalfWidth);
  vs.push_back(kHalfWidth);
  const auto height_at = [](std::size_t i, std::size_t j) {
    if (j == 0 || j == 2 * kTileCountZ) return 0.0;  // the borders along the walls
    if (i % 2 == 1 || j % 2 == 0) return -kGrooveDepth;
    Random random(1 + 1000 * i + j);
    return random.uniform(-0.01, 0.006);
  };
  add_relief(mesh, us, vs, height_at, [](double u, double v, double h) { return glm::dvec3(u, h, -v); });
}

void add_steps(Mesh& mesh) {
  constexpr int kStepCount = 5;
  for (int i = 0; i < kStepCount; ++i) {
    const double x = 12.05 + 0.4 * i;
    const double top = kPlatform * (i + 1) / kStepCount;
    // A tread with a nosing over the riser; its ends are in the walls.
    const double in_wall = kAtriumSink + 0.005 * i;
    add_box(mesh, {x, -0.1 - in_wall, -kHalfWidth - in_wall},
            {kHalfLength + in_wall, top - 0.05, kHalfWidth + in_wall});
    add_box(mesh, {x - 0.05, top - 0.06, -kHalfWidth - in_wall - 0.03},
            {kHalfLength + in_wall + 0.03, top, kHalfWidth + in_wall + 0.03});
  }
}

}  // namespace

Mesh make_atrium() {
  Mesh mesh;
  add_floor(mesh);
  add_steps(mesh);
  add_end_walls(mesh);
  for (double z_sign : {-1.0, 1.0}) {
    add_outer_wall(mesh, z_sign);
    add_aisle_ceiling(mesh, z_sign);
    add_arcade(mesh, z_sign * kRow);
    // The first and the last stand half in the end walls.
    for (int column = -1; column <= kColumnCount; ++column) {
      add_column(mesh, column_x(column), z_sign * kRow, column == kColumnCount ? kPlatform : 0);
    }
  }
  add_vault(mesh);
  add_ribs(mesh);
  add_atrium_furniture(mesh);
  return mesh;
}

}  // namespace lkao::scene
