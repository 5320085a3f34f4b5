#include "lod/decimater_modules.h"

#include <algorithm>
#include <limits>

#include "lod/surface_samples.h"

namespace lkao::lod {
namespace {

// Rows of samples of a triangle that is larger than the tolerance, at most.
constexpr double kMostRows = 8;
// The same where the new surface is held against the original: what is between samples is seen by nobody else.
constexpr double kMostRowsOfReach = 32;

float verdict(bool is_legal) {
  return is_legal ? float{DecimaterModule::LEGAL_COLLAPSE} : float{DecimaterModule::ILLEGAL_COLLAPSE};
}

// Samples that tell more than the corners do, at a spacing for the tolerance; none where the corners are enough.
bool sample_if_large(const Triangle& t, double tolerance, double spacing, double most_rows,
                     const std::function<bool(const glm::dvec3&)>& take) {
  const double longest = longest_side(t);
  if (kFarthestFromCorners * longest <= tolerance) return true;
  return sample_triangle(t, std::max(spacing, longest / most_rows),
                         [&](const glm::dvec3& p, double) { return take(p); });
}

}  // namespace

void triangles_after(const HalfEdgeMesh& mesh, const Collapse& c, std::vector<Triangle>& triangles) {
  triangles.clear();
  for (auto edge = mesh.cvoh_iter(c.v0); edge.is_valid(); ++edge) {
    const auto face = mesh.face_handle(*edge);
    if (!face.is_valid() || face == c.fl || face == c.fr) continue;
    const auto second = mesh.to_vertex_handle(*edge);
    const auto third = mesh.to_vertex_handle(mesh.next_halfedge_handle(*edge));
    triangles.push_back({to_glm(c.p1), to_glm(mesh.point(second)), to_glm(mesh.point(third))});
  }
}

// --- Priority -------------------------------------------------------------------------------------------------------

void set_quadrics(HalfEdgeMesh& mesh) {
  for (const auto vertex : mesh.vertices()) mesh.data(vertex).quadric.clear();
  for (const auto face : mesh.faces()) {
    auto corner = mesh.cfv_iter(face);
    const auto a = *corner, b = *++corner, c = *++corner;
    const HalfEdgeMesh::Point normal = cross(mesh.point(b) - mesh.point(a), mesh.point(c) - mesh.point(a));
    const double length = normal.norm();
    if (!(length > 0)) continue;
    Quadric quadric(normal / length, mesh.point(a));
    quadric *= 0.5 * length;
    for (const auto vertex : {a, b, c}) mesh.data(vertex).quadric += quadric;
  }
}

double collapse_cost(const HalfEdgeMesh& mesh, HalfEdgeMesh::HalfedgeHandle half_edge) {
  constexpr double kWeightOfLength = 1e-7;
  const auto from = mesh.from_vertex_handle(half_edge), to = mesh.to_vertex_handle(half_edge);
  const HalfEdgeMesh::Point& point = mesh.point(to);
  const double squared_length = (point - mesh.point(from)).sqrnorm();
  const double error = mesh.data(from).quadric(point) + mesh.data(to).quadric(point);
  return std::max(0.0, error) + kWeightOfLength * squared_length * squared_length;
}

double least_cost(const HalfEdgeMesh& mesh, HalfEdgeMesh::VertexHandle vertex) {
  double least = std::numeric_limits<double>::infinity();
  for (auto edge = mesh.cvoh_iter(vertex); edge.is_valid(); ++edge) least = std::min(least, collapse_cost(mesh, *edge));
  return least;
}

const std::string& QuadricModule::name() const {
  static const std::string kName = "Quadric";
  return kName;
}

float QuadricModule::collapse_priority(const Collapse& c) { return static_cast<float>(collapse_cost(mesh(), c.v0v1)); }

void QuadricModule::postprocess_collapse(const Collapse& c) { mesh().data(c.v1).quadric += mesh().data(c.v0).quadric; }

const std::string& GateModule::name() const {
  static const std::string kName = "Gate";
  return kName;
}

float GateModule::collapse_priority(const Collapse& c) {
  const unsigned there = mesh().valence(c.v1), after = there + mesh().valence(c.v0) - 4;
  return verdict(after <= std::max(there, kMostNeighbours));
}

// --- Borders --------------------------------------------------------------------------------------------------------

const std::string& BorderModule::name() const {
  static const std::string kName = "Border";
  return kName;
}

// v0 goes to v1 along the border; what the border was between v1 and the vertex behind v0 becomes one edge.
float BorderModule::collapse_priority(const Collapse& c) {
  if (!mesh().is_boundary(c.v0)) return verdict(true);
  const Vertex behind = vertex_behind(c);
  if (!behind.is_valid()) return verdict(false);
  const glm::dvec3 begin = to_glm(c.p1), end = to_glm(mesh().point(behind));
  const auto is_near = [&](const glm::dvec3& p) {
    return squared_distance_to_segment(p, begin, end) <= squared_tolerance_;
  };
  return verdict(is_near(to_glm(c.p0)) && std::ranges::all_of(points_of(c.v0, c.v1), is_near) &&
                 std::ranges::all_of(points_of(c.v0, behind), is_near));
}

// A collapse makes pairs of edges one; which of their handles lives on is OpenMesh's affair.
void BorderModule::preprocess_collapse(const Collapse& c) {
  merged_.clear();
  if (mesh().is_boundary(c.v0)) {
    const Vertex behind = vertex_behind(c);
    merge({c.v0, c.v1}, {c.v0, behind}, behind);
    merged_.back().second.push_back(to_glm(c.p0));
  }
  if (c.vl.is_valid()) merge({c.v0, c.vl}, {c.v1, c.vl}, c.vl);
  if (c.vr.is_valid()) merge({c.v0, c.vr}, {c.v1, c.vr}, c.vr);
}

void BorderModule::postprocess_collapse(const Collapse& c) {
  for (auto& [vertex, points] : merged_) points_of(c.v1, vertex) = std::move(points);
}

BorderModule::Vertex BorderModule::vertex_behind(const Collapse& c) {
  if (mesh().is_boundary(c.v0v1)) return mesh().from_vertex_handle(mesh().prev_halfedge_handle(c.v0v1));
  if (mesh().is_boundary(c.v1v0)) return mesh().to_vertex_handle(mesh().next_halfedge_handle(c.v1v0));
  return Vertex();
}

BorderModule::Points& BorderModule::points_of(Vertex a, Vertex b) {
  return mesh().data(mesh().edge_handle(mesh().find_halfedge(a, b))).gone;
}

void BorderModule::merge(std::pair<Vertex, Vertex> edge, std::pair<Vertex, Vertex> other, Vertex to) {
  Points points = points_of(edge.first, edge.second);
  const Points& more = points_of(other.first, other.second);
  points.insert(points.end(), more.begin(), more.end());
  merged_.emplace_back(to, std::move(points));
}

// --- From the original ----------------------------------------------------------------------------------------------

const std::string& GoneModule::name() const {
  static const std::string kName = "Gone";
  return kName;
}

void add_samples(HalfEdgeMesh& mesh, double tolerance) {
  for (const auto face : mesh.faces()) {
    auto corner = mesh.cfv_iter(face);
    Triangle t;
    t.a = to_glm(mesh.point(*corner));
    t.b = to_glm(mesh.point(*++corner));
    t.c = to_glm(mesh.point(*++corner));
    std::vector<glm::dvec3>& points = mesh.data(face).gone;
    sample_if_large(t, tolerance, tolerance, kMostRows, [&points](const glm::dvec3& p) {
      points.push_back(p);
      return true;
    });
  }
}

// `guess` is where a point before was near; the next one is often near there too.
bool GoneModule::is_near(const glm::dvec3& point, std::size_t& guess) const {
  const double squared_tolerance = tolerance_ * tolerance_;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const std::size_t candidate = (guess + i) % triangles_.size();
    if (squared_distance(point, triangles_[candidate]) > squared_tolerance) continue;
    guess = candidate;
    return true;
  }
  return false;
}

float GoneModule::collapse_priority(const Collapse& c) {
  triangles_after(mesh(), c, triangles_);
  if (triangles_.empty()) return verdict(false);
  std::size_t guess = 0;
  if (!is_near(to_glm(c.p0), guess)) return verdict(false);
  for (auto face = mesh().cvf_iter(c.v0); face.is_valid(); ++face) {
    for (const glm::dvec3& point : mesh().data(*face).gone) {
      if (!is_near(point, guess)) return verdict(false);
    }
  }
  return verdict(true);
}

void GoneModule::preprocess_collapse(const Collapse& c) {
  moved_.assign(1, to_glm(c.p0));
  faces_.clear();
  for (auto face = mesh().cvf_iter(c.v0); face.is_valid(); ++face) {
    Points& points = mesh().data(*face).gone;
    moved_.insert(moved_.end(), points.begin(), points.end());
    Points().swap(points);
  }
  // The faces that live on, in the order of their triangles.
  triangles_after(mesh(), c, triangles_);
  for (auto edge = mesh().cvoh_iter(c.v0); edge.is_valid(); ++edge) {
    const auto face = mesh().face_handle(*edge);
    if (face.is_valid() && face != c.fl && face != c.fr) faces_.push_back(face);
  }
}

void GoneModule::postprocess_collapse(const Collapse&) {
  for (const glm::dvec3& point : moved_) {
    std::size_t nearest = 0;
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      const double squared = squared_distance(point, triangles_[i]);
      if (squared < best) {
        best = squared;
        nearest = i;
      }
    }
    mesh().data(faces_[nearest]).gone.push_back(point);
  }
}

// --- To the original ------------------------------------------------------------------------------------------------

const std::string& ReachModule::name() const {
  static const std::string kName = "Reach";
  return kName;
}

void ReachModule::set_original(const NearCells& original, double scale, const glm::dvec3& origin) {
  original_ = &original;
  scale_ = scale;
  origin_ = origin;
  tolerance_ = original.distance() * scale;
}

float ReachModule::collapse_priority(const Collapse& c) {
  triangles_after(mesh(), c, triangles_);
  return verdict(std::ranges::all_of(triangles_, [this](const Triangle& t) { return is_near(t); }));
}

// What lies beyond mostly shows at a few samples already. The others are as dense as those that verify a level.
bool ReachModule::is_near(const Triangle& t) const {
  const auto take = [this](const glm::dvec3& p) { return original_->is_within(p / scale_ + origin_); };
  return sample_if_large(t, tolerance_, 2 * tolerance_, kMostRows, take) &&
         sample_if_large(t, tolerance_, 0.5 * tolerance_, kMostRowsOfReach, take);
}

}  // namespace lkao::lod
