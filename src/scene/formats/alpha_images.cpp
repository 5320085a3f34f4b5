#include "scene/formats/alpha_images.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace lkao::scene {

std::shared_ptr<const AlphaImage> AlphaImages::read(const std::string& name, const std::string& material, AlphaOf what,
                                                    const std::function<std::string()>& bytes) {
  try {
    AlphaImage image = decode_(name, bytes(), what);
    if (image.size() == 0) throw std::runtime_error(name + " has no pixels");
    image.least = *std::min_element(image.alphas.begin(), image.alphas.end());
    return std::make_shared<const AlphaImage>(std::move(image));
  } catch (const std::runtime_error& error) {
    faults_.push_back(fmt::format("{}: it counts as opaque, in material \"{}\"", error.what(), material));
    return nullptr;
  }
}

std::vector<std::string> AlphaImages::remarks() const {
  constexpr std::size_t kNamedCount = 3;
  if (faults_.size() <= kNamedCount) return faults_;
  std::vector<std::string> remarks(faults_.begin(), faults_.begin() + kNamedCount);
  remarks.push_back(fmt::format("{} more images cannot be read, and count as opaque", faults_.size() - kNamedCount));
  return remarks;
}

}  // namespace lkao::scene
