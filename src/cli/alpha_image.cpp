#include "cli/alpha_image.h"

#include "image/image.h"

namespace lkao::cli {

scene::AlphaImage decode_alpha(const std::string& name, std::string_view bytes, scene::AlphaOf what) {
  const image::Image image = image::decode_image(name, bytes);
  return {.width = image.width,
          .height = image.height,
          .alphas = image::alphas_of(image, what == scene::AlphaOf::alpha_or_grey)};
}

}  // namespace lkao::cli
