// Triangles with holes: leaves, fences, hair cards.
//
// Based on: M. McGuire, "Ambient Occlusion Volumes", HPG 2010, Sec. 5.3 (a triangle's mean alpha stands for its
// texture). Differs from the paper: rays are thinned by it, one by one, so that masks stay masks.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "lkao/requirements.h"

namespace lkao {

// Asked of a ray that meets a cut-out triangle, whether it is blocked there: the point is (1 - u - v) a + u b + v c,
// where a, b, c are the triangle's corners in the order of its indices. Look the texture up and compare alpha with the
// cut-off. Called in the middle of queries, from all their threads at once, for a ray and triangle perhaps more than
// once: it must answer the same every time. What it throws comes out of the query.
using CutOutFilter = std::function<bool(std::uint32_t instance, std::uint32_t primitive, float u, float v)>;

// What a filter says of all points of a part of a triangle.
enum class CutOutPart : std::uint8_t {
  mixed,   // this here and that there, or nobody knows
  clear,   // that no ray is blocked
  opaque,  // that every ray is blocked
};

// Asked, when a hierarchy is built, of the points of a triangle with u0 <= u <= u0 + size and v0 <= v <= v0 + size,
// where u and v are those of CutOutFilter, of any instance. What is wrong here is wrong in queries. Called from all
// threads of the build at once; what it throws comes out of the build.
using CutOutSurvey = std::function<CutOutPart(std::uint32_t primitive, float u0, float v0, float size)>;

// Which triangles of a mesh have holes. A ray that meets one is decided by itself; triangles without cost what they do
// otherwise.
struct CutOuts {
  // By primitive, from 0 to 1; those below 1 have holes. Empty: all have holes where there is a filter, none otherwise.
  std::vector<float> opacities = {};
  // Decides about triangles with holes. Empty: a ray is blocked with the opacity's probability. That is drawn from the
  // query's seed, the receiver's index, the ray's number, instance and primitive alone: the same on every kernel and
  // number of threads, and different for each pixel. The mean over many rays is that of half-transparent triangles.
  CutOutFilter blocks = {};
  // Spares most rays the filter, and the double precision with which (u, v) is found for it: triangles are looked at
  // beforehand, square by square, and where one is all clear or all opaque nothing is asked. Empty: every ray asks.
  CutOutSurvey survey = {};
  // For the survey, by primitive: triangles of the same number have the same holes, of which it is asked once. Empty:
  // each has its own.
  std::vector<std::uint32_t> looks = {};
};

}  // namespace lkao
