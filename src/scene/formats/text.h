// Texts as programs write them: lines that end in LF, CR or CR LF, words between blanks, numbers.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lkao::scene {

// The text behind a byte order mark, where it has one. Throws std::runtime_error for UTF-16 and UTF-32, which no mesh
// program writes.
std::string_view without_byte_order_mark(std::string_view text);

// Takes the first line off a text, without its end; false at the end of the text.
bool take_line(std::string_view& text, std::string_view& line);

// Blanks and line ends.
inline bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
inline void skip_blanks(std::string_view& text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
}

// Takes the first word off a text, and the blanks (line ends too) in front of it; empty where there is none left.
std::string_view take_word(std::string_view& text);

// One number: plain or scientific decimals, "nan", "inf", and what Windows prints for these ("-1.#IND",
// "-nan(ind)"). Throws std::runtime_error naming the word where it is not a number.
double parse_number(std::string_view word);
bool is_number(std::string_view word);

bool equal_but_for_case(std::string_view a, std::string_view b);

// The first characters of a text (UTF-8) of at most so many bytes, and dots where it has more.
std::string shortened(std::string_view text, std::size_t most);

// Words of a file, made fit for a message: short, without control characters.
std::string printable(std::string_view text);
std::string in_quotes(std::string_view text);  // that, in quotation marks

}  // namespace lkao::scene
