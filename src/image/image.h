// Float images with named channels, to and from files through OpenImageIO.
#pragma once

#include <string>
#include <vector>

namespace lkao::image {

struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;  // "occlusion", "depth.Z", "normal.X" ...
  std::vector<float> pixels;          // row by row from the top, channels interleaved

  int channel_count() const { return static_cast<int>(channels.size()); }
  // Index of a channel, -1 where there is none of that name.
  int channel(const std::string& name) const;
};

// Reads EXR, PNG and whatever else OpenImageIO knows; integers become [0, 1].
// Throws std::runtime_error with one line naming the file and the fault.
Image read_image(const std::string& path);

// Writes by the file name's ending: .exr as 32-bit float, all channels; .png as 8 bits. Nothing is left behind when it
// fails: the file appears complete or not at all.
// Throws std::runtime_error with one line naming the file and the fault.
void write_image(const std::string& path, const Image& image);

// The picture to look at: visibility = 1 - occlusion, sRGB-encoded grey; NaN (no receiver) as the background.
Image visibility_preview(const Image& occlusion);

}  // namespace lkao::image
