// How large a pass's own textures are, for pictures of several sizes that take turns.
#pragma once

#include <algorithm>
#include <cstdint>

namespace lkao::gl {

struct Size {
  int width, height;
};

inline std::int64_t area(const Size& size) { return std::int64_t{size.width} * size.height; }

// For a new picture beside those that fit into the old textures; for the new one alone where there would be more than
// four times as many pixels, as for one wide and one high picture.
inline Size grown_size(const Size& wanted, const Size& old) {
  const Size both{std::max(wanted.width, old.width), std::max(wanted.height, old.height)};
  return area(both) <= 4 * std::max(area(wanted), area(old)) ? both : wanted;
}

}  // namespace lkao::gl
