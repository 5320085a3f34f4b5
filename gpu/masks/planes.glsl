// The four planes of a triangle as a receiver sees it (Figure 1), in the precision `real`. With LKAO_DOUBLE this is
// bvh::TriangleTest; in float the same with float's rounding. Where it says "within rounding", a ray counts as blocked.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 3.1.
#include "gpu/frame/real.glsl"
#include "gpu/mesh/shapes.glsl"

#if LKAO_DOUBLE
const real kRounding = 1.7763568394002504646778106689453125e-15lf;  // 2^-49
#else
const real kRounding = 2.384185791015625e-7;  // 2^-22
#endif

struct Planes {
  real3 edges[3];  // rays that pass the triangle have edges[i] . ray >= -edge_slacks[i]
  real edge_slacks[3];
  bool has_edge[3];  // rounding has not turned the edge's plane out of the table's margin of 1e-5
  real3 normal;      // ... and normal . ray >= distance - normal_slack
  real distance;
  real normal_slack;
  bool has_normal;
  bool has_near;  // the same at the distance r_min
};

real norm(real3 v) { return abs(v.x) + abs(v.y) + abs(v.z); }

#if LKAO_DOUBLE

double precise_difference(double a, double b, double c, double d) {
  precise double first = a * b, second = c * d;
  precise double rest = fma(a, b, -first) - fma(c, d, -second);
  precise double difference = (first - second) + rest;
  return difference;
}

dvec3 precise_cross(dvec3 a, dvec3 b) {
  return dvec3(precise_difference(a.y, b.z, a.z, b.y), precise_difference(a.z, b.x, a.x, b.z),
               precise_difference(a.x, b.y, a.y, b.x));
}

void set_edge(inout Planes planes, int i, vec3 corner_from, vec3 corner_to, vec3 origin, double facing,
              double ray_norm) {
  precise dvec3 from = dvec3(corner_from) - dvec3(origin), to = dvec3(corner_to) - dvec3(origin);
  precise dvec3 sum = from + to, along = to - from;
  dvec3 edge = facing * precise_cross(sum, along);
  double slack = kRounding * (norm(edge) + 2.220446049250313e-16lf * norm(sum) * norm(along)) * ray_norm;
  planes.edges[i] = edge;
  planes.edge_slacks[i] = slack;
  planes.has_edge[i] = norm(edge) * ray_norm > 1e6lf * slack;
}

// False where the triangle blocks no ray at all.
bool make_planes(vec3 corner_a, vec3 corner_b, vec3 corner_c, vec3 unit_normal, vec3 origin, vec2 range,
                 out Planes planes) {
  precise dvec3 a = dvec3(corner_a) - dvec3(origin), b = dvec3(corner_b) - dvec3(origin),
                c = dvec3(corner_c) - dvec3(origin);
  precise dvec3 u = b - a, v = c - a;
  dvec3 normal = precise_cross(u, v);
  double size = norm(normal) + 2.220446049250313e-16lf * norm(u) * norm(v);
  precise double distance = a.x * normal.x + a.y * normal.y + a.z * normal.z;
  double ray_norm = 1.7321lf * double(ao_radius());
  if (abs(distance) <= kRounding * size * norm(a)) return false;
  if (abs(distance) > 1.001lf * double(range.y) * sqrt(dot(normal, normal))) return false;
  bool in_front = distance < 0.0lf;
  if (!in_front && !is_two_sided()) return false;
  double facing = in_front ? -1.0lf : 1.0lf;
  planes.normal = facing * normal;
  planes.distance = facing * distance;
  planes.normal_slack = kRounding * size * (norm(a) + ray_norm);
  planes.has_normal = norm(normal) * (1.7321lf * double(range.y)) > 1e6lf * planes.normal_slack;
  planes.has_near = norm(normal) * (1.7321lf * double(range.x)) > 1e6lf * planes.normal_slack;
  set_edge(planes, 0, corner_a, corner_b, origin, facing, ray_norm);
  set_edge(planes, 1, corner_b, corner_c, origin, facing, ray_norm);
  set_edge(planes, 2, corner_c, corner_a, origin, facing, ray_norm);
  return true;
}

#else

// A power of two that brings the AO radius to [1, 2): edges have the unit of a square, and their lengths that of its
// square, for which float has no room in very large and very small units. No bit changes otherwise.
float unit_scale() { return uintBitsToFloat(0x7f000000u - (floatBitsToUint(ao_radius()) & 0x7f800000u)); }

// The edge itself is taken from the corners as they are: far from the receiver, differences of differences would be
// noise. A neighbour that has the edge the other way round gets the same plane, negated.
void set_edge(inout Planes planes, int i, vec3 corner_from, vec3 corner_to, vec3 origin, float facing, float ray_norm) {
  float scale = unit_scale();
  precise vec3 from = (corner_from - origin) * scale, to = (corner_to - origin) * scale;
  precise vec3 sum = from + to, along = (corner_to - corner_from) * scale;
  precise vec3 edge = facing * vec3(sum.y * along.z - sum.z * along.y, sum.z * along.x - sum.x * along.z,
                                    sum.x * along.y - sum.y * along.x);
  float size = (norm(from) + norm(to)) * norm(along);
  planes.edges[i] = edge;
  planes.edge_slacks[i] = kRounding * (norm(edge) + size) * ray_norm;
  planes.has_edge[i] = norm(edge) > 0.05 * size;
}

// False where the triangle blocks no ray at all.
bool make_planes(vec3 corner_a, vec3 corner_b, vec3 corner_c, vec3 unit_normal, vec3 origin, vec2 range,
                 out Planes planes) {
  // Any corner tells the distance; the nearest tells it best.
  precise vec3 a = corner_a - origin, b = corner_b - origin, c = corner_c - origin;
  vec3 nearest = norm(a) <= norm(b) ? a : b;
  if (norm(c) < norm(nearest)) nearest = c;
  precise float distance = (nearest.x * unit_normal.x + nearest.y * unit_normal.y) + nearest.z * unit_normal.z;
  float ray_norm = 1.7321 * ao_radius(), rounding = kRounding * norm(nearest);
  // In the plane, to rounding, it would be met at the ray's open end only.
  if (abs(distance) <= rounding || abs(distance) > 1.001 * range.y + rounding) return false;
  bool in_front = distance < 0.0;
  if (!in_front && !is_two_sided()) return false;
  float facing = in_front ? -1.0 : 1.0;
  planes.normal = facing * unit_normal;
  planes.distance = facing * distance;
  planes.normal_slack = rounding + kRounding * ray_norm;
  planes.has_normal = rounding < 5e-6 * range.y;
  planes.has_near = rounding < 5e-6 * range.x;
  set_edge(planes, 0, corner_a, corner_b, origin, facing, ray_norm);
  set_edge(planes, 1, corner_b, corner_c, origin, facing, ray_norm);
  set_edge(planes, 2, corner_c, corner_a, origin, facing, ray_norm);
  return true;
}

#endif

bool blocks(Planes planes, vec3 ray) {
  precise real3 r = real3(ray);
  for (int i = 0; i < 3; ++i) {
    real3 edge = planes.edges[i];
    precise real beyond = (r.x * edge.x + r.y * edge.y) + r.z * edge.z;
    if (!(beyond >= -planes.edge_slacks[i])) return false;
  }
  precise real along = (r.x * planes.normal.x + r.y * planes.normal.y) + r.z * planes.normal.z;
  return along >= planes.distance - planes.normal_slack && ray != vec3(0.0);
}

// The same for the part of the ray from `begin` times to `end` times the ray.
bool blocks_part(Planes planes, vec3 ray, real begin, real end) {
  precise real3 r = real3(ray);
  precise real along = (r.x * planes.normal.x + r.y * planes.normal.y) + r.z * planes.normal.z;
  return blocks(planes, ray) && along * end >= planes.distance - planes.normal_slack &&
         along * begin <= planes.distance + planes.normal_slack;
}
