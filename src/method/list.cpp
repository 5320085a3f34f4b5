#include "method/list.h"

#include <algorithm>

#include "method/kinds.h"

namespace lkao::method {
namespace {

// Methods that need OpenGL are known by their words alone where the program is built without.
#if LKAO_METHOD_GL
#define LKAO_GL_KIND(kind) kind
#else
#define LKAO_GL_KIND(kind) [] { return MethodKind{}; }
#endif

constexpr Word<MethodKind (*)()> kMethods[] = {
    {"bvh", traversal_kind},
    {"embree", embree_kind},
    {"raster", LKAO_GL_KIND(masks_kind)},
    {"volumes", LKAO_GL_KIND(volumes_kind)},
    {"splat", LKAO_GL_KIND(splat_kind)},
    {"alchemy", LKAO_GL_KIND(alchemy_kind)},
    {"vao", LKAO_GL_KIND(vao_kind)},
    {"gtao", LKAO_GL_KIND(gtao_kind)},
    {"vbao", LKAO_GL_KIND(vbao_kind)},
};
constexpr std::size_t kTraversal = 0, kEmbree = 1;

std::vector<MethodKind> make_kinds() {
  std::vector<MethodKind> kinds;
  for (const auto& [word, make_kind] : kMethods) {
    kinds.push_back(make_kind());
    kinds.back().word = word;
  }
  return kinds;
}

}  // namespace

const std::vector<MethodKind>& method_kinds() {
  static const std::vector<MethodKind> kinds = make_kinds();
  return kinds;
}

std::vector<std::string> method_words() { return list_words(kMethods); }

const MethodKind& method_named(std::string_view word) {
  for (const MethodKind& kind : method_kinds()) {
    if (kind.word == word) return kind;
  }
  reject_word(method_words(), word);
}

const MethodKind& traversal() { return method_kinds()[kTraversal]; }

const MethodKind& reference_of(const MethodKind& kind) {
  const MethodKind& embree = method_kinds()[kEmbree];
  return kind.word == embree.word ? traversal() : embree;
}

std::vector<std::string> words_of_methods_with(const Setting& setting) {
  std::vector<std::string> words;
  for (const MethodKind& kind : method_kinds()) {
    const auto found = std::find(kind.settings.begin(), kind.settings.end(), &setting);
    if (found != kind.settings.end()) words.emplace_back(kind.word);
  }
  return words;
}

}  // namespace lkao::method
