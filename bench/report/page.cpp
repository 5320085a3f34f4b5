#include "bench/report/page.h"

#include <cstddef>

#include "bench/report/page_text.h"

namespace lkao::bench {
namespace {

void put_in(std::string& page, const std::string& place, const std::string& text) {
  page.replace(page.find(place), place.size(), text);
}

// Inside of <script>, nothing may look like its end.
std::string script_safe(std::string text) {
  for (std::size_t at = text.find("</"); at != std::string::npos; at = text.find("</", at)) text.replace(at, 2, "<\\/");
  return text;
}

}  // namespace

std::string make_page(const nlohmann::ordered_json& report) {
  std::string page = kPageHtml;
  put_in(page, "@STYLE@", kPageStyle);
  put_in(page, "@SCRIPT@", kPageScript);
  put_in(page, "@DATA@", script_safe(report.dump()));
  return page;
}

}  // namespace lkao::bench
