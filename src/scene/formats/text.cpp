#include "scene/formats/text.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

namespace lkao::scene {

namespace {

char to_lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// "1.#IND", "nan(ind)", "nan(snan)": not a number; "1.#INF": infinite.
bool parse_windows_word(std::string_view digits, double& value) {
  if (digits.starts_with("1.#INF")) {
    value = std::numeric_limits<double>::infinity();
    return true;
  }
  value = std::numeric_limits<double>::quiet_NaN();
  return digits.starts_with("1.#") || (digits.size() > 3 && equal_but_for_case(digits.substr(0, 4), "nan("));
}

}  // namespace

std::string_view without_byte_order_mark(std::string_view text) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) {
    throw std::runtime_error("the text is UTF-16 or UTF-32; UTF-8 is needed");
  }
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  return text;
}

bool take_line(std::string_view& text, std::string_view& line) {
  if (text.empty()) return false;
  const auto is_end = [](char c) { return c == '\n' || c == '\r'; };
  const auto end = static_cast<std::size_t>(std::find_if(text.begin(), text.end(), is_end) - text.begin());
  line = text.substr(0, end);
  text.remove_prefix(end);
  text.remove_prefix(text.starts_with("\r\n") ? 2 : text.empty() ? 0 : 1);
  return true;
}

std::string_view take_word(std::string_view& text) {
  skip_blanks(text);
  std::size_t end = 0;
  while (end < text.size() && !is_blank(text[end])) ++end;
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(end);
  return word;
}

double parse_number(std::string_view word) {
  std::string_view digits = word;
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc() && end == digits.data() + digits.size()) return value;
  // Too small for a double is zero to us; too large is infinite, a defect that is counted later.
  if (error == std::errc::result_out_of_range) return std::strtod(std::string(digits).c_str(), nullptr);
  const bool is_negative = digits.starts_with('-');
  if (parse_windows_word(digits.substr(is_negative ? 1 : 0), value)) return is_negative ? -value : value;
  throw std::runtime_error(fmt::format("\"{}\" is not a number", word.substr(0, 40)));
}

bool is_number(std::string_view word) {
  try {
    parse_number(word);
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

bool equal_but_for_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return to_lower(x) == to_lower(y); });
}

std::string shortened(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xc0) == 0x80) --most;
  return std::string(text.substr(0, most)) + "...";
}

std::string printable(std::string_view text) {
  std::string result = shortened(text, 60);
  for (char& c : result) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return result;
}

std::string in_quotes(std::string_view text) { return '"' + printable(text) + '"'; }

}  // namespace lkao::scene
