// From the boxes of triangles to a tree, with or without spatial splits.
#pragma once

#include <cstddef>
#include <span>

#include <tbb/enumerable_thread_specific.h>

#include "bvh/build_tree.h"
#include "bvh/memory_blocks.h"
#include "bvh/object_bins.h"
#include "bvh/packed_mesh.h"
#include "bvh/partition.h"
#include "bvh/piece.h"
#include "bvh/spatial_bins.h"
#include "lkao/progress.h"
#include "lut/progress_sum.h"

namespace lkao::bvh {

// Top down, by the surface area heuristic over bins, 8 children a node. The tree lives as long as this.
//
// Based on: M. Stich, H. Friedrich, A. Dietrich, "Spatial Splits in Bounding Volume Hierarchies", HPG 2009.
// Differs from the paper: each set of pieces has room for so many splits, so that the memory is known beforehand;
// planes are not tried where the children of the best split by centers overlap little.
class SplitBuilder {
 public:
  // The mesh must stay as it is meanwhile.
  SplitBuilder(const PackedMesh& mesh, bool spatial_splits) : mesh_(mesh), spatial_splits_(spatial_splits) {}

  // What the pieces of so many triangles should have reserved, for the builder to add to them.
  std::size_t capacity_for(std::size_t triangle_count) const;

  // The tree over the boxes of some triangles of the mesh, at least one. The same on any number of threads, on which it
  // runs in the caller's TBB arena. Throws Cancelled where `progress` stops it.
  const BuildTree& build(Pieces pieces, const Progress& progress = {});

 private:
  const BuildTree* build_tree(const PieceSet& set, int level, lut::ProgressSum& sum);
  const BuildTree* build_leaf(const PieceSet& set);
  const BuildTree* build_node(const PieceSet& set, int level, lut::ProgressSum& sum);
  int split_into_children(const PieceSet& set, int level, PieceSet (&children)[kWidth]);

  Halves split(const PieceSet& set, int level);
  Halves split_by_centers(const PieceSet& set, const CenterMap& map, const ObjectSplit& split);
  Halves split_by_plane(const PieceSet& set, SpatialSplit split);
  Halves split_in_middle(const PieceSet& set);

  ObjectSplit find_object_split(const PieceSet& set, const CenterMap& map) const;
  SpatialSplit find_spatial_split(const PieceSet& set) const;
  bool may_gain_by_planes(const PieceSet& set, const ObjectSplit& split) const;
  std::span<const Piece> pieces_of(const PieceSet& set) const { return {pieces_.data() + set.begin, set.size()}; }

  template <typename Tree>
  Tree* create();

  const PackedMesh& mesh_;
  const bool spatial_splits_;
  Pieces pieces_;
  tbb::enumerable_thread_specific<MemoryBlocks> memory_;
};

}  // namespace lkao::bvh
