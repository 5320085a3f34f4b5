# cmake -DROOT=<source folder> -P check_arrows.cmake
#
# Fails, naming each line, where a file includes what lies above it or beside it:
#   include <- lut <- bvh <- src/query = lkao::lkao
#   include <- lut <- gpu/gl <- gpu/frame <- gpu/mesh <- gpu/masks, gpu/frame <- gpu/screen: lkao::gl
#   lkao::lkao <- src/c_api: lkao::c, which nobody else sees
#   lkao::lkao <- src/scene <- src/reference, src/lod, src/bake      lkao::gl, src/scene <- src/raster
#   all of these but src/bake, src/image <- src/method; with it <- src/cli, bench
#   lkao::lkao, src/scene, src/bake, src/lod, src/image, src/raster <- src/python, which nobody else sees

cmake_minimum_required(VERSION 3.25)

# The first folders of internal includes, and the libraries that only some parts may know.
set(prefixes lkao lut bvh query c_api scene bake lod image reference raster method cli python bench gpu draco OpenMesh
             OpenImageIO epoxy EGL tbb embree)

set(may_include_include/lkao lkao)
set(may_include_lut lkao lut)
set(may_include_bvh lkao lut bvh tbb)
set(may_include_src/query lkao lut bvh query tbb)
set(may_include_src/c_api lkao c_api tbb)
foreach(folder IN ITEMS gl frame mesh masks volumes screen)
  set(may_include_gpu/${folder} lkao lut gpu epoxy EGL)
endforeach()
set(may_include_src/scene lkao lut bvh query scene draco tbb embree)
set(may_include_src/bake lkao lut scene bake tbb)
set(may_include_src/lod lkao lut scene lod OpenMesh tbb embree)
set(may_include_src/image lkao image OpenImageIO)
set(may_include_src/reference lkao lut bvh query scene reference tbb embree)
set(may_include_src/raster lkao gpu scene raster epoxy)
set(may_include_src/method lkao scene lod image reference raster method tbb)
set(may_include_src/cli lkao scene bake lod image method cli tbb)
set(may_include_src/python lkao scene bake lod image raster python tbb)
set(may_include_bench lkao lut bvh query scene bake lod image reference raster method bench tbb embree)

# Within gpu/.
set(gpu_may_include_gl gl)
set(gpu_may_include_frame gl frame)
set(gpu_may_include_mesh gl frame mesh)
set(gpu_may_include_masks gl frame mesh masks)
set(gpu_may_include_volumes gl frame mesh volumes)
set(gpu_may_include_screen gl frame screen)

# Public headers that stay on one side.
set(cpu_headers lkao/lkao.h lkao/occluder_bvh.h lkao/occluder_scene.h lkao/ambient_occlusion.h lkao/neighbourhood.h
                lkao/kernel.h lkao/ray_bundles.h lkao/sky_visibility.h lkao/soft_shadows.h)
set(lut_never_sees ${cpu_headers})
set(bvh_never_sees lkao/lkao.h lkao/ambient_occlusion.h lkao/neighbourhood.h lkao/ray_bundles.h
                   lkao/sky_visibility.h lkao/soft_shadows.h)
set(gl_parts src/raster src/method src/python bench)

set(offender_count 0)
set(file_count 0)

# judge(PART FILE LINE): counts and names the line where it is an include that PART may not have.
function(judge PART FILE LINE)
  string(REGEX REPLACE "^[^\"<]*[\"<]([^\">]*).*$" "\\1" header "${LINE}")
  string(REGEX REPLACE "[34]?/.*$" "" prefix "${header}")  # embree3/, embree4/
  set(is_wrong FALSE)
  if(prefix IN_LIST prefixes AND NOT prefix IN_LIST may_include_${PART})
    set(is_wrong TRUE)
  elseif(PART MATCHES "^gpu/(.*)$")
    set(folder "${CMAKE_MATCH_1}")
    if(header IN_LIST cpu_headers)
      set(is_wrong TRUE)
    elseif(header MATCHES "^gpu/([^/]*)/" AND NOT CMAKE_MATCH_1 IN_LIST gpu_may_include_${folder})
      set(is_wrong TRUE)
    endif()
  elseif(header IN_LIST ${PART}_never_sees)
    set(is_wrong TRUE)
  elseif(header MATCHES "^lkao/gl[./]" AND NOT PART IN_LIST gl_parts AND NOT FILE MATCHES "^include/lkao/gl[./]")
    set(is_wrong TRUE)
  endif()
  if(header MATCHES "^lkao/c[./]" AND NOT PART STREQUAL "src/c_api" AND NOT FILE MATCHES "^include/lkao/c[./]")
    set(is_wrong TRUE)
  endif()
  if(is_wrong)
    math(EXPR count "${offender_count} + 1")
    set(offender_count ${count} PARENT_SCOPE)
    message("${FILE}: ${LINE}: ${PART} may not include this")
  endif()
endfunction()

foreach(part IN ITEMS include/lkao lut bvh gpu/gl gpu/frame gpu/mesh gpu/masks gpu/volumes gpu/screen src/query
                      src/c_api src/scene src/bake src/lod src/image src/reference src/raster src/method src/cli
                      src/python bench)
  file(GLOB_RECURSE files RELATIVE "${ROOT}" "${ROOT}/${part}/*.h" "${ROOT}/${part}/*.cpp" "${ROOT}/${part}/*.glsl")
  foreach(file IN LISTS files)
    math(EXPR file_count "${file_count} + 1")
    file(STRINGS "${ROOT}/${file}" lines REGEX "^[ \t]*#[ \t]*include")
    foreach(line IN LISTS lines)
      judge("${part}" "${file}" "${line}")
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
