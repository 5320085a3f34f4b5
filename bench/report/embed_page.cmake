# cmake -DPAGE=<this folder's page/> -DOUTPUT=<file.cpp> -P embed_page.cmake
#
# Makes strings of the page's parts.

cmake_minimum_required(VERSION 3.25)

file(READ "${PAGE}/page.html" html)
file(READ "${PAGE}/page.css" style)
set(script "")
foreach(name IN ITEMS data plot viewer tables main)
  file(READ "${PAGE}/${name}.js" part)
  string(APPEND script "${part}\n")
endforeach()

file(WRITE "${OUTPUT}" "// Made by embed_page.cmake.
#include \"bench/report/page_text.h\"

namespace lkao::bench {

const char* const kPageHtml = R\"PAGE(${html})PAGE\";
const char* const kPageStyle = R\"PAGE(${style})PAGE\";
const char* const kPageScript = R\"PAGE(${script})PAGE\";

}  // namespace lkao::bench
")
