#include "scene/obj_writer.h"

#include <sstream>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace lkao::scene {
namespace {

Mesh small_triangle() { return {{{0, 0, 0}, {0.1f, 0, 0}, {0, 1, -2.5f}}, {{0, 1, 2}}}; }

std::string text_of(const Mesh& mesh, ColourCoding coding) {
  std::ostringstream out;
  write_obj(out, mesh, std::vector<float>{0, 0.5f, 1}, coding);
  return out.str();
}

TEST(ObjWriter, HasColoursBehindCoordinates) {
  EXPECT_EQ(text_of(small_triangle(), ColourCoding::linear),
            "v 0 0 0 1 1 1\nv 0.1 0 0 0.5 0.5 0.5\nv 0 1 -2.5 0 0 0\nf 1 2 3\n");
  EXPECT_EQ(text_of(small_triangle(), ColourCoding::srgb),
            "v 0 0 0 1 1 1\nv 0.1 0 0 0.73536 0.73536 0.73536\nv 0 1 -2.5 0 0 0\nf 1 2 3\n");
}

TEST(ObjWriter, AddsTheOriginWithAllDigits) {
  Mesh mesh = small_triangle();
  mesh.origin = {500000, 5000000, 0};
  EXPECT_EQ(text_of(mesh, ColourCoding::linear),
            "v 500000 5000000 0 1 1 1\nv 500000.10000000149 5000000 0 0.5 0.5 0.5\n"
            "v 500000 5000001 -2.5 0 0 0\nf 1 2 3\n");
}

TEST(ObjWriter, RefusesTheWrongNumberOfValues) {
  std::ostringstream out;
  EXPECT_THROW(write_obj(out, small_triangle(), std::vector<float>{0, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace lkao::scene
