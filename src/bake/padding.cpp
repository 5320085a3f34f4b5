#include "bake/padding.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "bake/texel_neighbours.h"

namespace lkao::bake {
namespace {

bool is_known(float value) { return !std::isnan(value); }
bool is_known(const glm::vec3& value) { return !std::isnan(value.x); }

glm::vec3 direction_of(const glm::vec3& sum) {
  const float length = glm::length(sum);
  return length > 1e-6f ? sum / length : glm::vec3(0, 0, 1);
}

// Ring by ring: the texels of the next one, and their values.
class Ring {
 public:
  Ring(TextureMap& map, const TextureOptions& options) : map_(map), neighbours_(map.width, map.height, options) {
    is_listed_.resize(map.size());
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        if (is_known(map.occlusion[map.texel(x, y)])) list_around({x, y});
      }
    }
  }

  bool is_empty() const { return texels_.empty(); }

  void fill() {
    std::vector<float> occlusion;
    std::vector<glm::vec3> bent_normals;
    occlusion.reserve(texels_.size());
    for (const glm::ivec2& texel : texels_) {
      const Mean mean = mean_around(texel);
      occlusion.push_back(mean.occlusion);
      if (!map_.bent_normals.empty()) bent_normals.push_back(mean.bent_normal);
    }
    const std::vector<glm::ivec2> filled = std::move(texels_);
    texels_.clear();
    for (std::size_t i = 0; i < filled.size(); ++i) {
      const std::size_t texel = map_.texel(filled[i].x, filled[i].y);
      map_.occlusion[texel] = occlusion[i];
      if (!bent_normals.empty()) map_.bent_normals[texel] = bent_normals[i];
    }
    for (const glm::ivec2& texel : filled) list_around(texel);
  }

 private:
  struct Mean {
    float occlusion;
    glm::vec3 bent_normal;
  };

  // Calls take(texel) for those of the 8 that exist.
  template <class Take>
  void for_each_around(const glm::ivec2& texel, const Take& take) const {
    const bool is_inside = texel.x > 0 && texel.y > 0 && texel.x + 1 < map_.width && texel.y + 1 < map_.height;
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) {
        if (is_inside) {
          if (x != 0 || y != 0) take(texel + glm::ivec2(x, y));
          continue;
        }
        const std::optional<glm::ivec2> other = neighbours_.at(texel + glm::ivec2(x, y));
        if (other && *other != texel) take(*other);
      }
    }
  }

  void list_around(const glm::ivec2& texel) {
    for_each_around(texel, [this](const glm::ivec2& other) {
      const std::size_t number = map_.texel(other.x, other.y);
      if (is_known(map_.occlusion[number]) || is_listed_[number]) return;
      is_listed_[number] = true;
      texels_.push_back(other);
    });
  }

  Mean mean_around(const glm::ivec2& texel) const {
    double sum = 0;
    int count = 0;
    glm::vec3 directions(0.0f);
    for_each_around(texel, [&](const glm::ivec2& other) {
      const std::size_t number = map_.texel(other.x, other.y);
      if (!is_known(map_.occlusion[number])) return;
      sum += static_cast<double>(map_.occlusion[number]);
      ++count;
      if (!map_.bent_normals.empty()) directions += map_.bent_normals[number];
    });
    return {static_cast<float>(sum / count), direction_of(directions)};
  }

  TextureMap& map_;
  TexelNeighbours neighbours_;
  std::vector<bool> is_listed_;
  std::vector<glm::ivec2> texels_;
};

// A level of a mip chain.
template <class Value>
struct Level {
  int width, height;
  std::vector<Value> values;

  std::size_t texel(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

template <class Value>
const Value kUnknown{std::numeric_limits<float>::quiet_NaN()};

template <class Value>
Level<Value> reduced(int width, int height, const std::vector<Value>& values) {
  Level<Value> half{(width + 1) / 2, (height + 1) / 2, {}};
  half.values.resize(static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height));
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      Value sum(0.0f);
      int count = 0;
      for (int row = 2 * y; row < std::min(2 * y + 2, height); ++row) {
        for (int column = 2 * x; column < std::min(2 * x + 2, width); ++column) {
          const Value& value = values[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                                      static_cast<std::size_t>(column)];
          if (!is_known(value)) continue;
          sum += value;
          ++count;
        }
      }
      half.values[half.texel(x, y)] = count > 0 ? sum / static_cast<float>(count) : kUnknown<Value>;
    }
  }
  return half;
}

template <class Value>
void fill_from(const Level<Value>& half, int width, int height, std::vector<Value>& values) {
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Value& value =
          values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
      if (!is_known(value)) value = half.values[half.texel(x / 2, y / 2)];
    }
  }
}

template <class Value>
void flood_values(int width, int height, std::vector<Value>& values) {
  std::vector<Level<Value>> levels;
  for (int w = width, h = height; w > 1 || h > 1; w = levels.back().width, h = levels.back().height) {
    levels.push_back(reduced(w, h, levels.empty() ? values : levels.back().values));
  }
  for (std::size_t i = levels.size(); i-- > 1;) {
    fill_from(levels[i], levels[i - 1].width, levels[i - 1].height, levels[i - 1].values);
  }
  if (!levels.empty()) fill_from(levels[0], width, height, values);
}

}  // namespace

void grow(TextureMap& map, int margin, const TextureOptions& options) {
  if (margin == 0) return;
  Ring ring(map, options);
  for (int i = 0; i < margin && !ring.is_empty(); ++i) ring.fill();
}

void flood(TextureMap& map) {
  flood_values(map.width, map.height, map.occlusion);
  if (map.bent_normals.empty()) return;
  flood_values(map.width, map.height, map.bent_normals);
  for (glm::vec3& normal : map.bent_normals) normal = is_known(normal) ? direction_of(normal) : normal;
}

}  // namespace lkao::bake
