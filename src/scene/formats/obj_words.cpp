#include "scene/formats/obj_words.h"

#include <charconv>
#include <system_error>

#include "scene/formats/text.h"

namespace lkao::scene {

namespace {

bool is_line_end(char c) { return c == '\n' || c == '\r'; }
bool is_blank_or_line_end(char c) { return static_cast<unsigned char>(c) <= ' '; }

}  // namespace

// Behind a backslash and the line end that it takes away, blanks between them or not; null where there is no such.
const char* ObjWords::behind_continuation(const char* at) const {
  if (*at != '\\') return nullptr;
  do ++at;
  while (at != end_ && is_blank_or_line_end(*at) && !is_line_end(*at));
  if (at == end_) return at;
  if (!is_line_end(*at)) return nullptr;
  return at + (at + 1 != end_ && at[0] == '\r' && at[1] == '\n' ? 2 : 1);
}

bool ObjWords::is_word_end(const char* at) const {
  if (at == end_ || is_blank_or_line_end(*at)) return true;
  if (*at == '#') return at[-1] != '.';  // "1.#IND" is a number on Windows
  return behind_continuation(at) != nullptr;
}

void ObjWords::skip_line() {
  while (at_ != end_ && !is_line_end(*at_)) ++at_;
  if (at_ != end_) ++at_;
}

bool ObjWords::has_word() {
  while (at_ != end_) {
    if (is_blank_or_line_end(*at_)) {
      if (is_line_end(*at_)) return false;
      ++at_;
    } else if (const char* const behind = behind_continuation(at_)) {
      at_ = behind;
    } else {
      return *at_ != '#';
    }
  }
  return false;
}

std::string_view ObjWords::take_word() {
  if (!has_word()) return {};
  const char* const begin = at_;
  while (!is_word_end(at_)) ++at_;
  return {begin, static_cast<std::size_t>(at_ - begin)};
}

double ObjWords::take_number() {
  if (!has_word()) return parse_number({});
  double value = 0;
  const auto [behind, error] = std::from_chars(at_, end_, value);
  if (error != std::errc() || !is_word_end(behind)) return parse_number(take_word());
  at_ = behind;
  return value;
}

std::string_view ObjWords::take_rest() {
  while (at_ != end_ && is_blank_or_line_end(*at_) && !is_line_end(*at_)) ++at_;
  const char* const begin = at_;
  const char* behind_last_word = at_;
  for (; at_ != end_ && !is_line_end(*at_); ++at_) {
    if (is_blank_or_line_end(*at_)) continue;
    if (*at_ == '#' && (at_ == begin || is_blank_or_line_end(at_[-1]))) break;
    behind_last_word = at_ + 1;
  }
  return {begin, static_cast<std::size_t>(behind_last_word - begin)};
}

std::size_t ObjWords::line_number() const {
  std::string_view before(begin_, static_cast<std::size_t>(at_ - begin_));
  std::size_t number = 1;
  for (std::size_t end; (end = before.find_first_of("\r\n")) != before.npos; ++number) {
    before.remove_prefix(end + (before.substr(end).starts_with("\r\n") ? 2 : 1));
  }
  return number;
}

}  // namespace lkao::scene
