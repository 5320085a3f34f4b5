// The readers behind read_mesh_file, one a family of formats. All throw std::runtime_error with the fault alone; the
// caller puts the file's name in front. Indices may still be out of range: read_mesh_file checks them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "scene/mesh.h"

namespace lkao::scene {

// PLY: ASCII and binary of either byte order; faces and triangle strips.
//
// Read here and not through assimp 5.2, which takes truncated files without a word and which loses a line feed, and
// with it every later value, where the binary data happens to begin with one.
Mesh read_ply(std::string_view bytes);

// OFF, with or without normals, colours and texture coordinates; comments anywhere.
//
// Read here and not through assimp 5.2, which drops polygons of more than nine corners, replaces indices that are out
// of range, and takes truncated files without a word.
Mesh read_off(std::string_view bytes);

// OBJ, STL, glTF and GLB through assimp. `bytes` is the content of the file, to check that what assimp hands over is
// all that is in it. `extension` is in lower case, without the dot.
Mesh read_through_assimp(const std::string& path, std::string_view bytes, const std::string& extension);

// Adds a polygon as a fan around its first corner; nothing where it has fewer than three.
void add_polygon(Mesh& mesh, std::span<const std::uint32_t> polygon);

// One number of a text: plain or scientific decimals, "nan", "inf". Throws naming the word where it is not a number.
double parse_number(std::string_view word);

}  // namespace lkao::scene
