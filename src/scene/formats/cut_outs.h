// Triangles of materials that have holes by transparency.
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "scene/contents.h"

namespace lkao::scene {

class CutOuts {
 public:
  // `material` as a remark shall call it.
  void add(const std::string& material, std::size_t triangle_count) { counts_[material] += triangle_count; }

  // Adds the count, and a line for each of the materials with most triangles and one for all others.
  void report(Contents& contents) const;

 private:
  std::map<std::string, std::size_t> counts_;
};

}  // namespace lkao::scene
