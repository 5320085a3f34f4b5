#include "cli/render_images.h"

#include <limits>
#include <vector>

#include "cli/output_files.h"
#include "image/image.h"

namespace lkao::cli {
namespace {

image::Image blank(const scene::ReceiverImage& view, std::vector<std::string> channels, float value) {
  const std::size_t value_count = view.depth.size() * channels.size();
  return {view.width, view.height, std::move(channels), std::vector<float>(value_count, value)};
}

// Puts into `channel` of every pixel that sees a triangle what `value_of(pixel)` says.
template <class ValueOf>
void fill(image::Image& image, const std::string& channel, const scene::ReceiverImage& view, ValueOf value_of) {
  const auto stride = static_cast<std::size_t>(image.channel_count());
  float* const first = image.pixels.data() + image.channel(channel);
  for (std::size_t pixel = 0; pixel < view.receivers.size(); ++pixel) {
    if (view.sees(pixel)) first[pixel * stride] = value_of(pixel);
  }
}

void fill_all(image::Image& image, const std::string& channel, float value) {
  const auto stride = static_cast<std::size_t>(image.channel_count());
  for (auto i = static_cast<std::size_t>(image.channel(channel)); i < image.pixels.size(); i += stride) {
    image.pixels[i] = value;
  }
}

template <class VectorOf>
void fill_vectors(image::Image& image, const std::string& layer, const scene::ReceiverImage& view, VectorOf vector_of) {
  fill(image, layer + ".X", view, [&](std::size_t pixel) { return vector_of(pixel).x; });
  fill(image, layer + ".Y", view, [&](std::size_t pixel) { return vector_of(pixel).y; });
  fill(image, layer + ".Z", view, [&](std::size_t pixel) { return vector_of(pixel).z; });
}

std::vector<std::string> channel_names(const ImageLayers& layers) {
  std::vector<std::string> names = {layers.visibility ? "visibility" : "occlusion"};
  if (layers.bent_normals) names.insert(names.end(), {"bent.X", "bent.Y", "bent.Z"});
  if (layers.depth) names.push_back("depth.Z");
  if (layers.normals) names.insert(names.end(), {"normal.X", "normal.Y", "normal.Z"});
  return names;
}

image::Image make_layers(const scene::ReceiverImage& view, const method::Batch& batch, const ImageLayers& layers) {
  image::Image image = blank(view, channel_names(layers), 0);
  if (layers.visibility) {
    fill_all(image, "visibility", 1);
    fill(image, "visibility", view, [&](std::size_t pixel) { return 1 - batch.occlusion[pixel]; });
  } else {
    fill(image, "occlusion", view, [&](std::size_t pixel) { return batch.occlusion[pixel]; });
  }
  if (layers.bent_normals)
    fill_vectors(image, "bent", view, [&](std::size_t pixel) { return batch.bent_normals[pixel]; });
  if (layers.normals)
    fill_vectors(image, "normal", view, [&](std::size_t pixel) { return view.receivers[pixel].normal; });
  if (layers.depth) {
    const auto stride = static_cast<std::size_t>(image.channel_count());
    float* const first = image.pixels.data() + image.channel("depth.Z");
    for (std::size_t pixel = 0; pixel < view.depth.size(); ++pixel) first[pixel * stride] = view.depth[pixel];
  }
  return image;
}

image::Image make_preview(const scene::ReceiverImage& view, const method::Batch& batch) {
  image::Image occlusion = blank(view, {"occlusion"}, std::numeric_limits<float>::quiet_NaN());
  fill(occlusion, "occlusion", view, [&](std::size_t pixel) { return batch.occlusion[pixel]; });
  return image::visibility_preview(occlusion);
}

}  // namespace

void write_rendering(const std::string& path, const scene::ReceiverImage& view, const method::Batch& batch,
                     const ImageLayers& layers) {
  image::write_image(path, ending_of(path) == ".png" ? make_preview(view, batch) : make_layers(view, batch, layers));
}

}  // namespace lkao::cli
