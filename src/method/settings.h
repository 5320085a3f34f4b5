// Settings of methods, as data: the program makes options of them, a study varies them.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "method/words.h"

namespace lkao::method {

// Finite numbers from `least` to `most`.
struct Range {
  double least;
  double most;
  bool is_whole = false;  // only whole ones
};

// One that several methods share is one object: it is told apart by its address.
struct Setting {
  std::string name;                                      // "masks": the option --masks
  std::string help;                                      // one sentence without its full stop
  std::variant<std::vector<std::string>, Range> values;  // one of these words, or a number
  std::string default_text;
  bool is_flag = false;  // of two words: to name it on a command line is to choose the second

  // Throws std::invalid_argument saying what was expected, where the text is none of the values.
  void check(const std::string& text) const;
  // The words, "simd|scalar", or the range, "0..1": for help.
  std::string values_text() const;
};

// A setting that is one of the words of an enum.
template <class Value, std::size_t kCount>
Setting word_setting(std::string name, std::string help, const Word<Value> (&words)[kCount],
                     std::type_identity_t<Value> default_value) {
  return {std::move(name), std::move(help), list_words(words), std::string(word_of(words, default_value))};
}

// One that is off unless it is named.
Setting flag_setting(std::string name, std::string help);

// What was chosen; everything else is at its default.
class Settings {
 public:
  // Throws as Setting::check().
  void set(const Setting& setting, const std::string& text);
  // Those that were set.
  std::vector<const Setting*> chosen() const;

  // As it was given, or the default.
  const std::string& text(const Setting& setting) const;
  // Of a setting with a range.
  double number(const Setting& setting) const;
  // Of a flag.
  bool flag(const Setting& setting) const;
  // Of a setting that was made of these words.
  template <class Value, std::size_t kCount>
  Value value(const Setting& setting, const Word<Value> (&words)[kCount]) const {
    return parse_word(words, text(setting));
  }

 private:
  std::map<const Setting*, std::string> chosen_;
};

// Of a setting with a range of whole numbers.
inline int whole(const Settings& settings, const Setting& setting) {
  return static_cast<int>(settings.number(setting));
}

}  // namespace lkao::method
