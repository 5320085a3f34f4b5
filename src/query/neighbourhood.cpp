#include "lkao/neighbourhood.h"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "lut/coordinates.h"
#include "query/answer.h"
#include "query/tracer.h"

namespace lkao {
namespace {

bool holds(const Bounds& box, const glm::vec3& p) {
  return box.lower.x <= p.x && p.x <= box.upper.x && box.lower.y <= p.y && p.y <= box.upper.y && box.lower.z <= p.z &&
         p.z <= box.upper.z;
}

}  // namespace

struct Neighbourhood::State {
  // `ao` keeps the tracer alive that `visit` is about.
  State(const AmbientOcclusion& the_ao, const query::Tracer& tracer, const Bounds& the_positions)
      : ao(the_ao), positions(the_positions), visit(tracer, the_positions) {}

  AmbientOcclusion ao;
  Bounds positions;
  query::Tracer::Visit visit;
  ReceiverRays rays;
};

Neighbourhood::Neighbourhood(std::unique_ptr<State> state) : state_(std::move(state)) {}
Neighbourhood::~Neighbourhood() = default;
Neighbourhood::Neighbourhood(Neighbourhood&&) noexcept = default;
Neighbourhood& Neighbourhood::operator=(Neighbourhood&&) noexcept = default;

ReceiverOcclusion Neighbourhood::query(const Receiver& receiver, std::uint64_t index) {
  if (!holds(state_->positions, receiver.position)) return state_->ao.query(receiver, index);
  const OcclusionMask blocked = state_->visit.trace(receiver, index, state_->rays);
  return query::make_answer(state_->ao.pattern(), receiver, state_->rays, blocked);
}

OcclusionMask Neighbourhood::blocked(const Receiver& receiver, std::uint64_t index) {
  if (!holds(state_->positions, receiver.position)) return state_->ao.blocked(receiver, index);
  return state_->visit.trace(receiver, index, state_->rays);
}

Neighbourhood AmbientOcclusion::around(const Bounds& positions) const {
  const glm::vec3 &a = positions.lower, &b = positions.upper;
  if (!lut::is_in_range(a) || !lut::is_in_range(b) || !holds(positions, a)) {
    throw std::invalid_argument(
        fmt::format("positions must be a box with lower <= upper within 1e18, not ({}, {}, {}) to ({}, {}, {})", a.x,
                    a.y, a.z, b.x, b.y, b.z));
  }
  return Neighbourhood(std::make_unique<Neighbourhood::State>(*this, *tracer_, positions));
}

}  // namespace lkao
