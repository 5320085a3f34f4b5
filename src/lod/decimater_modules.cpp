#include "lod/decimater_modules.h"

#include <algorithm>
#include <limits>

#include "lod/surface_samples.h"

namespace lkao::lod {
namespace {

// Rows of samples of a triangle that is larger than the tolerance, at most.
constexpr double kMostRows = 8;

glm::dvec3 to_glm(const HalfEdgeMesh::Point& p) { return {p[0], p[1], p[2]}; }

float verdict(bool is_legal) {
  return is_legal ? float{DecimaterModule::LEGAL_COLLAPSE} : float{DecimaterModule::ILLEGAL_COLLAPSE};
}

// Samples that tell more than the corners do; none where the corners are enough.
bool sample_if_large(const Triangle& t, double tolerance, const std::function<bool(const glm::dvec3&)>& take) {
  const double longest = longest_side(t);
  if (kFarthestFromCorners * longest <= tolerance) return true;
  return sample_triangle(t, std::max(tolerance, longest / kMostRows),
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

float QuadricModule::cost(const Collapse& c) {
  constexpr double kWeightOfLength = 1e-7;
  const double squared_length = (c.p1 - c.p0).sqrnorm();
  const auto length_term = static_cast<float>(kWeightOfLength * squared_length * squared_length);
  return std::max(0.0f, ModQuadricT::collapse_priority(c)) + length_term;
}

float QuadricModule::collapse_priority(const Collapse& c) {
  const float priority = cost(c);
  best_ = std::min(best_, priority);
  return priority;
}

bool QuadricModule::is_better(const Collapse& c) {
  if (c.v0 != vertex_) {
    vertex_ = c.v0;
    best_ = std::numeric_limits<float>::max();
  }
  return cost(c) < best_;
}

void QuadricModule::postprocess_collapse(const Collapse& c) {
  ModQuadricT::postprocess_collapse(c);
  vertex_ = HalfEdgeMesh::VertexHandle();
}

const std::string& GateModule::name() const {
  static const std::string kName = "Gate";
  return kName;
}

float GateModule::collapse_priority(const Collapse& c) {
  const unsigned there = mesh().valence(c.v1), after = there + mesh().valence(c.v0) - 4;
  return verdict(after <= std::max(there, kMostNeighbours) && quadric_->is_better(c));
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
  return mesh().property(gone_, mesh().edge_handle(mesh().find_halfedge(a, b)));
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

void GoneModule::add_samples() {
  for (const auto face : mesh().faces()) {
    auto corner = mesh().cfv_iter(face);
    Triangle t;
    t.a = to_glm(mesh().point(*corner));
    t.b = to_glm(mesh().point(*++corner));
    t.c = to_glm(mesh().point(*++corner));
    Points& points = mesh().property(gone_, face);
    sample_if_large(t, tolerance_, [&points](const glm::dvec3& p) {
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
    for (const glm::dvec3& point : mesh().property(gone_, *face)) {
      if (!is_near(point, guess)) return verdict(false);
    }
  }
  return verdict(true);
}

void GoneModule::preprocess_collapse(const Collapse& c) {
  moved_.assign(1, to_glm(c.p0));
  faces_.clear();
  for (auto face = mesh().cvf_iter(c.v0); face.is_valid(); ++face) {
    Points& points = mesh().property(gone_, *face);
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
    mesh().property(gone_, faces_[nearest]).push_back(point);
  }
}

// --- To the original ------------------------------------------------------------------------------------------------

const std::string& ReachModule::name() const {
  static const std::string kName = "Reach";
  return kName;
}

float ReachModule::collapse_priority(const Collapse& c) {
  triangles_after(mesh(), c, triangles_);
  return verdict(std::ranges::all_of(triangles_, [this](const Triangle& t) { return is_near(t); }));
}

bool ReachModule::is_near(const Triangle& t) const {
  return sample_if_large(t, tolerance_, [this](const glm::dvec3& p) { return is_within_(p, tolerance_); });
}

}  // namespace lkao::lod
