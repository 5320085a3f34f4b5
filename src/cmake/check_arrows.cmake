# cmake -DROOT=<source folder> -P check_arrows.cmake
#
# Fails, naming each line, where a file includes what lies above it or beside it:
#   include <- lut <- bvh <- src/query = lkao::lkao
#   include <- lut <- gpu/gl <- gpu/frame <- gpu/mesh <- gpu/masks, gpu/frame <- gpu/screen: lkao::gl
#   lkao::lkao <- src/scene <- src/reference, src/lod      src/image <- src/cli -> everything
#   lkao::gl, src/scene <- src/raster

cmake_minimum_required(VERSION 3.25)

# The first folders of internal includes, and the libraries that only some parts may know.
set(prefixes lkao lut bvh query scene lod image reference raster cli gpu assimp OpenMesh OpenImageIO epoxy EGL embree3)

set(may_include_include/lkao lkao)
set(may_include_lut lkao lut)
set(may_include_bvh lkao lut bvh)
set(may_include_src/query lkao lut bvh query)
set(may_include_gpu lkao lut gpu epoxy EGL)
set(may_include_src/scene lkao lut bvh query scene assimp embree3)
set(may_include_src/lod lkao lut scene lod OpenMesh embree3)
set(may_include_src/image lkao image OpenImageIO)
set(may_include_src/reference lkao lut bvh query scene reference embree3)
set(may_include_src/raster lkao gpu scene raster epoxy)

# Public headers that stay on one side.
set(lut_never_sees lkao/lkao.h lkao/occluder_bvh.h lkao/ambient_occlusion.h)
set(bvh_never_sees lkao/lkao.h lkao/ambient_occlusion.h)
set(gpu_never_sees ${lut_never_sees})
set(only_gl_sees lkao/gl.h)
set(gl_parts gpu src/raster)

set(offender_count 0)
set(file_count 0)
foreach(part IN ITEMS include/lkao lut bvh gpu src/query src/scene src/lod src/image src/reference src/raster)
  file(GLOB_RECURSE files RELATIVE "${ROOT}" "${ROOT}/${part}/*.h" "${ROOT}/${part}/*.cpp")
  foreach(file IN LISTS files)
    math(EXPR file_count "${file_count} + 1")
    file(STRINGS "${ROOT}/${file}" lines REGEX "^[ \t]*#[ \t]*include")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE "^[^\"<]*[\"<]([^\">]*).*$" "\\1" header "${line}")
      string(REGEX REPLACE "/.*$" "" prefix "${header}")
      set(is_wrong FALSE)
      if(prefix IN_LIST prefixes AND NOT prefix IN_LIST may_include_${part})
        set(is_wrong TRUE)
      elseif(header IN_LIST ${part}_never_sees)
        set(is_wrong TRUE)
      elseif(NOT part IN_LIST gl_parts AND header IN_LIST only_gl_sees)
        set(is_wrong TRUE)
      endif()
      if(is_wrong)
        math(EXPR offender_count "${offender_count} + 1")
        message("${file}: ${line}: ${part} may not include this")
      endif()
    endforeach()
  endforeach()
endforeach()

if(file_count EQUAL 0)
  message(FATAL_ERROR "no source files under ROOT '${ROOT}'")
endif()
if(offender_count GREATER 0)
  message(FATAL_ERROR "${offender_count} includes against the arrows")
endif()
message(STATUS "${file_count} files follow the arrows")
