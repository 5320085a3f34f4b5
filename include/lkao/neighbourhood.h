// Queries of receivers that lie near each other.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 5. Not of the
// paper: entering the hierarchy at the nodes that rays from a box can reach (bvh/entry_nodes.h).
#pragma once

#include <cstdint>
#include <memory>

#include "lkao/ambient_occlusion.h"
#include "lkao/export.h"
#include "lkao/requirements.h"

namespace lkao {

// For renderers that shade point by point, one for each tile of the image: its single queries begin at the nodes that
// rays from the tile can reach, as those of a batch do, and share one memory of what blocked rays. Made by
// AmbientOcclusion::around() in some microseconds; takes a few kilobytes; copies nothing of the scene and keeps it
// alive.
//
// For one thread at a time; different ones may be used in different threads. Answers are those of AmbientOcclusion, bit
// for bit. A receiver outside of the box is answered too, no faster than by AmbientOcclusion.
class LKAO_API Neighbourhood {
 public:
  ~Neighbourhood();
  Neighbourhood(Neighbourhood&&) noexcept;
  Neighbourhood& operator=(Neighbourhood&&) noexcept;

  // As AmbientOcclusion::query and blocked.
  ReceiverOcclusion query(const Receiver& receiver, std::uint64_t index);
  OcclusionMask blocked(const Receiver& receiver, std::uint64_t index);

 private:
  friend class AmbientOcclusion;
  struct State;
  explicit Neighbourhood(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

}  // namespace lkao
