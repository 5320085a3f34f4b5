// The words of OBJ and MTL texts.
#pragma once

#include <cstddef>
#include <string_view>

namespace lkao::scene {

// Walks over a text line by line, and over each line word by word. A line ends in LF, CR or CR LF, goes on where it
// ends in a backslash, and what stands behind a # is a comment.
class ObjWords {
 public:
  explicit ObjWords(std::string_view text) : begin_(text.data()), at_(begin_), end_(begin_ + text.size()) {}

  bool is_at_end() const { return at_ == end_; }
  // Passes over what is left of the line.
  void skip_line();
  // Counted from 1.
  std::size_t line_number() const;

  // Whether there is another word on the line.
  bool has_word();
  // The next word; empty at the end of the line.
  std::string_view take_word();
  // Throws std::runtime_error where the next word is no number (parse_number).
  double take_number();
  // The words up to the end of the line as they stand there: names may have blanks and # in them and end in a
  // backslash.
  std::string_view take_rest();

 private:
  const char* behind_continuation(const char* at) const;
  bool is_word_end(const char* at) const;

  const char* begin_;
  const char* at_;
  const char* end_;
};

}  // namespace lkao::scene
