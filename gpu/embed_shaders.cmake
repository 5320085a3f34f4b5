# cmake -DSOURCE=<folder of shaders> -DEXPANDED=<folder> -DOUTPUT=<file.cpp> -P embed_shaders.cmake
#
# Puts the included files into each name.stage.glsl (each once), writes the result to EXPANDED for the validator, and all of
# them as strings to OUTPUT, so that a program needs no files at run time.

cmake_minimum_required(VERSION 3.25)

# expand(NAME VARIABLE): the text of a shader without #include.
function(expand NAME VARIABLE)
  file(READ "${SOURCE}/${NAME}" text)
  set(included "")
  while(text MATCHES "(^|\n)(#include \"([^\"]+)\"[^\n]*)")
    set(line "${CMAKE_MATCH_2}")
    set(file "${CMAKE_MATCH_3}")
    set(part "")
    if(NOT file IN_LIST included)
      list(APPEND included "${file}")
      file(READ "${SOURCE}/${file}" part)
    endif()
    # The first one only: string(REPLACE) would put the part in as often as it is asked for.
    string(FIND "${text}" "${line}" place)
    string(LENGTH "${line}" length)
    math(EXPR rest "${place} + ${length}")
    string(SUBSTRING "${text}" 0 ${place} before)
    string(SUBSTRING "${text}" ${rest} -1 after)
    set(text "${before}${part}${after}")
  endwhile()
  set(${VARIABLE} "${text}" PARENT_SCOPE)
endfunction()

set(entries "")
file(GLOB files RELATIVE "${SOURCE}" "${SOURCE}/*.*.glsl")
list(SORT files)
foreach(file IN LISTS files)
  expand("${file}" text)
  file(CONFIGURE OUTPUT "${EXPANDED}/${file}" CONTENT "@text@" @ONLY NEWLINE_STYLE UNIX)
  string(REGEX REPLACE "\\.glsl$" "" name "${file}")
  string(APPEND entries "    {\"${name}\", R\"GLSL(${text})GLSL\"},\n")
endforeach()
# For tests of single functions.
foreach(file IN ITEMS pass.glsl plane_cells.glsl)
  expand("${file}" text)
  string(APPEND entries "    {\"${file}\", R\"GLSL(${text})GLSL\"},\n")
endforeach()

file(WRITE "${OUTPUT}" "// Made by embed_shaders.cmake.
#include \"gpu/shader_sources.h\"

#include <stdexcept>
#include <string>

namespace lkao::gl {
namespace {

struct Source {
  const char* name;
  const char* text;
};

const Source kSources[] = {
${entries}};

}  // namespace

const char* shader_source(const std::string& name) {
  for (const Source& source : kSources) {
    if (name == source.name) return source.text;
  }
  throw std::logic_error(\"no shader is called \" + name);
}

}  // namespace lkao::gl
")
