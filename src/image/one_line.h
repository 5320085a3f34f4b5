// Messages of other libraries, made fit for an error of one line.
#pragma once

#include <cctype>

#include <string>

namespace lkao::image {

// The text with every run of white space (line ends too) as one blank, none at the ends.
inline std::string one_line(const std::string& text) {
  std::string line;
  for (const char c : text) {
    if (std::isspace(static_cast<unsigned char>(c)) == 0) {
      line += c;
    } else if (!line.empty() && line.back() != ' ') {
      line += ' ';
    }
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line.empty() ? "unknown fault" : line;
}

}  // namespace lkao::image
