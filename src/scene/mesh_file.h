// Mesh files in: OBJ, PLY, STL, OFF, glTF and GLB. The readers are in formats/.
#pragma once

#include <optional>
#include <string>

#include "scene/contents.h"
#include "scene/holes.h"
#include "scene/mesh.h"

namespace lkao::scene {

struct MeshFile {
  Mesh mesh;
  Contents contents;
};

struct ReadOptions {
  // Of the mesh; without it the one that the file names (write_ply), or what lkao::choose_origin() says.
  std::optional<glm::dvec3> origin = {};
  // The number of the texture coordinates to read, with the materials that they are for; without it neither is read.
  std::optional<int> uv_set = {};
  // Reads which triangles are one object (Mesh::objects): what a node of a glTF shows, each of its instances by itself;
  // what an OBJ has under one name of "o", or where it has none of those of "g". Other formats name no objects.
  bool objects = false;
  // Reads images for holes by transparency (Mesh::holes). Of glTF: alphaMode MASK is exact, BLEND by chance. Of OBJ, by
  // chance: what "d" or "Tr" says, times the alpha of the image of "map_d", or how bright it is where it has none, so
  // that an image of black and white alone is exact; of its options "-s", "-o" and "-clamp" are obeyed, and a remark
  // names others that would change it. Other formats know none. Without it triangles of such materials are whole, and a
  // remark says so. An image that cannot be read counts as opaque, so that the alpha of factor and colours is left, and
  // is a remark as well.
  DecodeAlpha decode_alpha = {};
};

// Reads every triangle of the file: node transforms applied, polygons cut into triangles, points and lines left out,
// degenerate and non-finite triangles kept (drop_bad_triangles sorts those out). Vertices keep the file's numbers, used
// or not; only those of STL, which gives every corner its own, are joined where their positions are equal.
//
// Throws std::runtime_error with one line naming the file and the fault: missing, a directory, an unsupported type,
// empty, truncated or malformed, an index out of range, no triangles.
MeshFile open_mesh_file(const std::string& path, const ReadOptions& options = {});

// The mesh alone.
Mesh read_mesh_file(const std::string& path, const ReadOptions& options = {});

}  // namespace lkao::scene
