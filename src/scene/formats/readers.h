// The readers behind read_mesh_file, one a family of formats. All throw std::runtime_error with the fault alone; the
// caller puts the file's name in front. Indices of vertices may still be out of range: read_mesh_file checks them.
// Whatever the bytes, a reader takes no more memory than a few times their number, and does not recurse.
//
// `uv_set` is the number of the texture coordinates to read, with the materials; without it neither is read. Formats
// other than glTF have set 0 alone.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "scene/formats/file_mesh.h"
#include "scene/holes.h"

namespace lkao::scene {

// PLY: ASCII and binary of either byte order; faces and triangle strips. Texture coordinates of vertices, or of the
// corners of faces; materials are the textures that the header names, where faces have numbers of them.
FileMesh read_ply(std::string_view bytes, std::optional<int> uv_set = {});

// OFF, with or without normals, colours and texture coordinates; comments anywhere.
FileMesh read_off(std::string_view bytes, std::optional<int> uv_set = {});

// What is in the file of that name beside the one that is read; nothing where there is no such file.
using ReadBeside = std::function<std::optional<std::string>(const std::string& name)>;

struct MeshWishes {
  std::optional<int> uv_set = {};
  bool objects = false;           // as of ReadOptions
  DecodeAlpha decode_alpha = {};  // for holes by transparency
};

// OBJ: faces; lines, points and free-form surfaces are left out. Material files are looked at for holes by transparency
// alone.
FileMesh read_obj(std::string_view bytes, const ReadBeside& read_beside, const MeshWishes& wishes = {});

// STL: text and binary. Corners at equal positions are joined; normals and colours are not read.
FileMesh read_stl(std::string_view bytes);

// glTF 2.0 and GLB, whatever the file's name ends in. Buffers in files of their own are found beside `path`. What is
// shown or used many times takes its memory as often.
FileMesh read_gltf(const std::string& path, std::string_view bytes, const MeshWishes& wishes = {});

}  // namespace lkao::scene
