// Small files of every format, changed at random places.
#include <iterator>
#include <string>
#include <string_view>

#include "fuzz/target.h"
#include "lut/random.h"

namespace lkao::tests {
namespace {

// With its zero bytes.
template <std::size_t kSize>
constexpr std::string_view whole(const char (&text)[kSize]) {
  return {text, kSize - 1};
}

// The format's number (mesh_fuzzer.cpp), then the file.
constexpr std::string_view kFiles[] = {
    whole("\0mtllib a.mtl\nv 0 0 0\nv 3 0 0 1 0 0\nv 3 3 0\n v 2 1 .5\nv 0 3 0 # corner\nvt 0 0\nvn 0 0 1\nusemtl "
          "leaves\n"
          "f 1/1/1 2/1/1 3 4//-1 5/1\nf -1 -2 \\\n-3\ns 1\nvt 1 2 3\nvt 9\ng a b\nl 1 2\nsurf 0 1\nf 9 8 7\nnewmtl "
          "leaves\nmap_d a\nd "
          ".5\n"),
    whole("\1solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1e3 0\nvertex .2 .1 "
          "0\nendloop\n"
          "endfacet\nfacet normal -nan(ind) 0 1\r\nOUTER LOOP\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nend loop\n"
          "end facet\nend solid a\n"),
    whole("\1title                                                                           \2\0\0\0"
          "nnnnnnnnnnnnaaaabbbbccccaaaabbbb\0\0\0\0ccccaaaabbbb\0\0nnnnnnnnnnnnaaaabbbbccccaaaabbbb\0\0\0\0ccccaaaabbbb"
          "\0\0"),
    whole("\2ply\nformat ascii 1.0\ncomment c\nelement vertex 5\nproperty float x\nproperty double y\nproperty int z\n"
          "element face 2\nproperty uchar q\nproperty list uchar int vertex_indices\nelement tristrips 1\n"
          "property list int int vertex_indices\nend_header\n0 0 0\n3 0 0\n3 3 0\n2 1 0\n0 3 0\n7 5 0 1 2 3 4\n7 3 0 1 "
          "2\n"
          "5 0 1 2 -1 3\n"),
    whole("\2ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\nproperty "
          "uchar z\n"
          "element face 1\nproperty list uchar uchar vertex_index\nend_header\naaabbbacb\3\0\1\2"),
    whole("\2ply\nformat ascii 1.0\ncomment TextureFile a\nelement vertex 3\nproperty float s\nproperty float t\n"
          "property float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar float texcoord\n"
          "property int texnumber\nproperty list uchar int vertex_indices\nend_header\n0 1 0 0 0\n0 1 3 0 0\n"
          "0 1 3 3 0\n6 0 1 2 3 4 5 0 3 0 1 2\n"),
    whole("\3STOFF\n3 1 0\n0 0 0 1 1\n1 0 0 0 0\n1 1 0 0 0\n3 0 1 2\n"),
    whole("\3OFF # counts\n5 2 0\n0 0 0\n3 0 0\n3 3 0\n2 1 0\n0 3 0\n5 0 1 2 3 4 255 0 0\n3 0 1 2\n"),
    whole("\3COFF\n3 1 0\n0 0 0 1 1 1 1\n1 0 0 0 0 0 0\n1 1 0 0 0 0 0\n3 0 1 2\n"),
};

// With a bar between them.
constexpr std::string_view kPieces =
    "\n|\r|\r\n| |\\\n|#|-|0|1|9|.5|/|//|1e400|nan|99999999|4294967295|v |vn |f |usemtl |mtllib a|solid|end|facet|loop|"
    "vertex|list |uchar |element vertex 9\n|\xef\xbb\xbf|\xff\xff\xff\xff";

std::string_view random_piece(lut::RandomStream& random) {
  std::string_view pieces = kPieces;
  pieces.remove_prefix(random.next_below(pieces.size()));
  pieces.remove_prefix(pieces.find('|') + 1);
  return pieces.substr(0, pieces.find('|'));
}

}  // namespace

std::vector<std::uint8_t> bytes_of_seed(std::uint64_t seed) {
  lut::RandomStream random(seed);
  std::string bytes(kFiles[random.next_below(std::size(kFiles))]);
  for (std::uint64_t change = random.next_below(8); change > 0; --change) {
    const std::size_t at = 1 + random.next_below(bytes.size() - 1);
    const std::size_t count = random.next_below(random.next_below(4) == 0 ? 200 : 8);
    switch (random.next_below(4)) {
      case 0:
        bytes[at] = static_cast<char>(random.next_bits());
        break;
      case 1:
        bytes.erase(at, count);
        break;
      case 2:
        bytes.insert(at, bytes.substr(1 + random.next_below(bytes.size() - 1), count));
        break;
      default:
        bytes.insert(at, random_piece(random));
    }
    if (bytes.size() < 2) bytes += ' ';
  }
  return {bytes.begin(), bytes.end()};
}

}  // namespace lkao::tests
