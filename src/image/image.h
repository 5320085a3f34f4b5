// Float images with named channels, to and from files through OpenImageIO.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
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

// Reads EXR, PNG and whatever else OpenImageIO knows; integers become [0, 1], nothing else is converted. The channels
// of an EXR come in the order of that format, not in the one they were written in: find them by name.
// Throws std::runtime_error with one line naming the file and the fault. Prints nothing.
Image read_image(const std::string& path);

// The same of a PNG, JPEG or WebP in memory; `path` is what messages name.
Image decode_image(const std::string& path, std::string_view bytes);

// The alpha of every pixel, row by row: 0 is clear, 65535 opaque, alphas of 8 and of 16 bits exactly. An image without
// is opaque everywhere; or, with `or_brightness`, as opaque as it is bright, for images that show nothing else.
std::vector<std::uint16_t> alphas_of(const Image& image, bool or_brightness);

// Writes by the file name's ending: .exr as 32-bit float, all channels, bit for bit; .png as 8 bits, 1 to 4 channels,
// values as they are (sRGB-encoded already), clamped to [0, 1] and rounded, NaN as 0. Equal images are equal files: the
// date in an EXR's header is always the same. Nothing is left behind when it
// fails: the file appears complete or not at all (AtomicFile).
// Throws std::runtime_error with one line naming the file and the fault. Prints nothing.
void write_image(const std::string& path, const Image& image);

// The bytes of the .png that write_image would write; `path` is what messages name.
std::string encode_png(const std::string& path, const Image& image);

// Throws what write_image would throw for this file name and its folder, before there is an image to lose.
void check_image_path(const std::string& path);

// The picture to look at: visibility = 1 - occlusion as sRGB-encoded grey in the channels R, G, B; pixels without a
// receiver (NaN) as a dark blue. Takes the channel "occlusion", or the only channel.
// Throws std::invalid_argument where there is neither.
Image visibility_preview(const Image& occlusion);

// b - a in these channels. Throws std::invalid_argument where the sizes differ or a channel is missing.
Image difference(const Image& a, const Image& b, const std::vector<std::string>& channels);

// The picture of a difference, its mean over the channels: white where there is none, red above, blue below, in full
// colour from 1 / gain on; black where it is NaN. Channels R, G, B. `gain` is positive.
Image difference_preview(const Image& difference, float gain);

}  // namespace lkao::image
