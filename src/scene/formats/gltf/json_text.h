// A JSON text that is changed in a few places and stays as it is, byte for byte, in all others: numbers keep their
// spelling, members their order, and what nobody here knows is kept.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lkao::scene::gltf {

// Looks at no more than what it is asked for, and does not recurse.
class JsonText {
 public:
  // A value in the text, by its first byte.
  using Place = std::size_t;

  // `text` is one value, and known to be JSON.
  explicit JsonText(std::string text);
  JsonText(const JsonText&) = delete;
  JsonText& operator=(const JsonText&) = delete;

  Place root() const { return root_; }
  // A member of an object: of several with the same key the last, as parsers have it.
  std::optional<Place> find(Place object, std::string_view key) const;
  // The members of an object but for some, spelled as they are: "\"key\":value".
  std::vector<std::string> members_but(Place object, const std::set<std::string>& left_out) const;
  // Of a list; the index is below its size().
  Place element(Place list, std::size_t index) const { return children(list)[index].value; }
  std::size_t size(Place list) const { return children(list).size(); }
  // As it was read.
  std::string_view text_of(Place value) const;

  // Changes, of each value once at most; `value` is JSON. None may be in what another puts away.
  void set(Place object, std::string_view key, const std::string& value);  // in the place of the member, or as one more
  void append(Place list, const std::string& value);                       // any number of times
  void replace(Place value, std::string by) { replacements_[value] = std::move(by); }

  // The text with all changes.
  std::string changed() const;

 private:
  struct Child {
    std::string_view key;  // as it is spelled, without quotes; empty in a list
    Place value;
    std::size_t end;  // behind the value
  };

  const std::vector<Child>& children(Place container) const;
  void insert(Place container, const std::string& value);

  std::string text_;
  Place root_;
  mutable std::map<Place, std::vector<Child>> children_;  // of what was looked at
  std::map<Place, std::string> replacements_;             // of values
  std::map<Place, std::string> insertions_;               // behind all that a container has
};

// "{a,b}" of members or elements; of elements with other brackets.
std::string joined(const std::vector<std::string>& parts, char open = '{', char close = '}');

// A text as JSON spells it, in quotation marks.
std::string to_json_string(std::string_view text);

}  // namespace lkao::scene::gltf
