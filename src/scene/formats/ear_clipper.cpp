#include "scene/formats/ear_clipper.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace lkao::scene {

namespace {

// Sine of the smallest angle that is told from none: rounding of a tilted plane must not make ears of straight corners.
constexpr double kFlatSine = 1e-12;

double flat_turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return kFlatSine * glm::length(b - a) * glm::length(c - b);
}

}  // namespace

void EarClipper::clip(std::span<const glm::dvec2> polygon, std::vector<glm::uvec3>& triangles) {
  link(polygon);
  for (std::size_t left = polygon.size(); left > 2; --left) {
    Rule rule = kSpike;
    std::uint32_t corner = take(rule);
    while (!may_clip(corner, rule)) {
      push(corner, static_cast<Rule>(rule + 1));
      corner = take(rule);
    }
    const std::uint32_t previous = previous_[corner], next = next_[corner];
    triangles.emplace_back(previous, corner, next);
    ++versions_[corner];
    tree_.mark(corner, false);
    next_[previous] = next;
    previous_[next] = previous;
    refresh(previous);
    refresh(next);
  }
}

void EarClipper::link(std::span<const glm::dvec2> polygon) {
  const auto count = static_cast<std::uint32_t>(polygon.size());
  polygon_ = polygon;
  previous_.resize(count);
  next_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    previous_[i] = i == 0 ? count - 1 : i - 1;
    next_[i] = i + 1 == count ? 0 : i + 1;
  }
  versions_.assign(count, 0);
  for (Queue& queue : queues_) {
    queue.candidates.clear();
    queue.first = 0;
  }
  tree_.build(polygon);
  // Ordinary polygons need some hundred looks a corner.
  work_limit_ = 100'000 + 5'000 * polygon.size();
  for (std::uint32_t i = 0; i < count; ++i) refresh(i);
}

void EarClipper::refresh(std::uint32_t corner) {
  const glm::dvec2 &a = before(corner), &b = polygon_[corner], &c = after(corner);
  tree_.mark(corner, turn(a, b, c) <= flat_turn(a, b, c));
  ++versions_[corner];
  push(corner, kSpike);
}

// The next corner under the strictest rule that has one; every corner left waits under one rule.
std::uint32_t EarClipper::take(Rule& rule) {
  for (rule = kSpike;; rule = static_cast<Rule>(rule + 1)) {
    Queue& queue = queues_[rule];
    while (queue.first < queue.candidates.size()) {
      const Candidate candidate = queue.candidates[queue.first++];
      if (candidate.version == versions_[candidate.corner]) return candidate.corner;
    }
  }
}

bool EarClipper::may_clip(std::uint32_t corner, Rule rule) {
  if (rule == kAny) return true;
  const glm::dvec2 &a = before(corner), &b = polygon_[corner], &c = after(corner);
  const double area = turn(a, b, c);
  const double flat = flat_turn(a, b, c);
  if (rule == kSpike || rule == kFlat) {
    // A spike goes back where it came from, or nowhere.
    return std::abs(area) <= flat && (rule == kFlat || glm::dot(a - b, c - b) >= 0);
  }
  if (area <= flat || tree_.work() > work_limit_) return false;
  return rule == kEar ? is_ear(corner) : is_open_ear(corner);
}

bool EarClipper::is_ear(std::uint32_t corner) {
  return !tree_.any_in({before(corner), polygon_[corner], after(corner)}, [&](std::uint32_t other) {
    return other != previous_[corner] && other != next_[corner] && enters(other, corner);
  });
}

// Whether a corner on the closed triangle of another one, or an edge of it, gets in the way: corners that merely touch
// the triangle from outside do not.
bool EarClipper::enters(std::uint32_t other, std::uint32_t corner) const {
  const glm::dvec2 &a = before(corner), &b = polygon_[corner], &c = after(corner);
  const glm::dvec2& p = polygon_[other];
  // An edge from there that cuts the triangle ends in it, or at one of the places below.
  if (p == a || p == c) return false;
  const auto is_left = [&](const glm::dvec2& q) { return turn(a, b, q) > 0; };
  const auto is_right = [&](const glm::dvec2& q) { return turn(b, c, q) > 0; };
  const glm::dvec2 &before_p = before(other), &after_p = after(other);
  if (p == b) return (is_left(before_p) && is_right(before_p)) || (is_left(after_p) && is_right(after_p));
  if (turn(a, b, p) == 0) return is_left(before_p) || is_left(after_p);
  if (turn(b, c, p) == 0) return is_right(before_p) || is_right(after_p);
  return true;
}

// Nothing lies well inside the triangle: what touches its border is taken for rounding.
bool EarClipper::is_open_ear(std::uint32_t corner) {
  constexpr double kBorder = 1e-9;
  const glm::dvec2 &a = before(corner), &b = polygon_[corner], &c = after(corner);
  const double border = kBorder * turn(a, b, c);
  return !tree_.any_in({a, b, c}, [&](std::uint32_t other) {
    const glm::dvec2& p = polygon_[other];
    return turn(a, b, p) > border && turn(b, c, p) > border && turn(c, a, p) > border;
  });
}

}  // namespace lkao::scene
