// The parts of the page, from the files in page/.
#pragma once

namespace lkao::bench {

extern const char* const kPageHtml;
extern const char* const kPageStyle;
extern const char* const kPageScript;

}  // namespace lkao::bench
