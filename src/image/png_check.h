// Damaged PNG files, found before libpng finds them: it prints its errors, and OpenImageIO does not stop it.
#pragma once

#include <string>
#include <string_view>

namespace lkao::image {

// What is wrong with the chunks of a PNG file: cut off, or a checksum that does not match. Empty where they are sound,
// or where the file has not the signature of a PNG.
std::string find_png_damage(const std::string& path);
// The same of the bytes of a file.
std::string find_png_damage_in(std::string_view bytes);

}  // namespace lkao::image
