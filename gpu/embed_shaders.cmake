# cmake -DROOT=<folder of the project> -DEXPANDED=<folder> -DOUTPUT=<file.cpp> -P embed_shaders.cmake
#
# Puts the included files into each shader of gpu/ (each once), writes those of a stage, such as
# gpu/mesh/prism.vert.glsl, to EXPANDED for the validator, and all of them as strings to OUTPUT, so that a program needs
# no files at run time.

cmake_minimum_required(VERSION 3.25)

# expand(FILE VARIABLE): the text of a shader without #include. Headers of C++, in angle brackets, are left out.
function(expand FILE VARIABLE)
  file(READ "${ROOT}/${FILE}" text)
  set(included "")
  while(text MATCHES "(^|\n)(#include \"([^\"]+)\"[^\n]*)")
    set(line "${CMAKE_MATCH_2}")
    set(file "${CMAKE_MATCH_3}")
    set(part "")
    if(NOT file IN_LIST included)
      list(APPEND included "${file}")
      file(READ "${ROOT}/${file}" part)
    endif()
    # The first one only: string(REPLACE) would put the part in as often as it is asked for.
    string(FIND "${text}" "${line}" place)
    string(LENGTH "${line}" length)
    math(EXPR rest "${place} + ${length}")
    string(SUBSTRING "${text}" 0 ${place} before)
    string(SUBSTRING "${text}" ${rest} -1 after)
    set(text "${before}${part}${after}")
  endwhile()
  string(REGEX REPLACE "\n#include <[^\n]*" "" text "${text}")
  set(${VARIABLE} "${text}" PARENT_SCOPE)
endfunction()

set(entries "")
file(GLOB_RECURSE files RELATIVE "${ROOT}" "${ROOT}/gpu/*.glsl")
list(SORT files)
foreach(file IN LISTS files)
  expand("${file}" text)
  string(REGEX REPLACE "^gpu/(.*)\\.glsl$" "\\1" name "${file}")
  string(APPEND entries "    {\"${name}\", R\"GLSL(${text})GLSL\"},\n")
  if(name MATCHES "\\.")
    file(CONFIGURE OUTPUT "${EXPANDED}/${name}.glsl" CONTENT "@text@" @ONLY NEWLINE_STYLE UNIX)
  endif()
endforeach()

file(WRITE "${OUTPUT}" "// Made by embed_shaders.cmake.
#include \"gpu/gl/shader_sources.h\"

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
