# Finds what the chosen parts need, and says at once which Debian packages are missing.

# So that a project which adds this one as a subfolder can link lkao::lkao.
set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)

set(lkao_missing "")

# find_package(NAME ...); DEBIAN is the package that provides it.
macro(lkao_find NAME DEBIAN)
  find_package(${NAME} ${ARGN} QUIET)
  if(NOT ${NAME}_FOUND)
    list(APPEND lkao_missing ${DEBIAN})
  endif()
endmacro()

# Makes the target PkgConfig::NAME from pkg-config's MODULE.
macro(lkao_find_pkg_config NAME MODULE DEBIAN)
  if(PkgConfig_FOUND)
    pkg_check_modules(${NAME} QUIET IMPORTED_TARGET GLOBAL ${MODULE})
  endif()
  if(NOT ${NAME}_FOUND)
    list(APPEND lkao_missing ${DEBIAN})
  endif()
endmacro()

lkao_find(Threads libc6-dev)
lkao_find(glm libglm-dev CONFIG)
lkao_find(fmt libfmt-dev CONFIG)
# Compiled in, so that no user of lkao needs it, whatever standard library it is built for.
set(lkao_fmt "$<BUILD_INTERFACE:fmt::fmt-header-only>")
lkao_find(hwy libhwy-dev CONFIG)
if(LKAO_BUILD_CPU)
  lkao_find(TBB libtbb-dev CONFIG)
endif()

if(LKAO_BUILD_TOOLS OR LKAO_BUILD_GL)
  lkao_find(PkgConfig pkg-config)
endif()

if(LKAO_BUILD_TOOLS)
  # Embree 4 before 3; -D embree_DIR=FOLDER names another.
  find_package(embree 4 CONFIG QUIET)
  if(NOT embree_FOUND)
    lkao_find(embree libembree-dev 3 CONFIG)
  endif()
  if(embree_FOUND)
    # src/scene/embree.h includes the one that is linked, whatever headers lie beside it.
    add_library(lkao_embree INTERFACE)
    target_link_libraries(lkao_embree INTERFACE embree)
    target_compile_definitions(lkao_embree INTERFACE LKAO_EMBREE_VERSION_MAJOR=${embree_VERSION_MAJOR})
  endif()
  lkao_find(draco libdraco-dev CONFIG)
  lkao_find(meshoptimizer libmeshoptimizer-dev CONFIG)
  lkao_find(CLI11 libcli11-dev CONFIG)
  lkao_find(nlohmann_json nlohmann-json3-dev CONFIG)
  lkao_find(OpenMesh libopenmesh-dev CONFIG)
  # Debian 12's CMake package of OpenImageIO names a folder of OpenCV that is not installed with it; pkg-config works.
  lkao_find_pkg_config(OpenImageIO OpenImageIO libopenimageio-dev)
  if(OpenImageIO_FOUND)
    add_library(lkao_openimageio INTERFACE)
    target_link_libraries(lkao_openimageio INTERFACE PkgConfig::OpenImageIO)
  endif()
endif()

if(LKAO_BUILD_GL)
  lkao_find_pkg_config(epoxy epoxy libepoxy-dev)
  lkao_find_pkg_config(egl egl libegl-dev)
endif()

# A sanitizer's runtime must be the first thing that a program loads, which is Python's own.
if(NOT LKAO_BUILD_CPU OR NOT LKAO_BUILD_TOOLS OR LKAO_SANITIZE)
  set(LKAO_BUILD_PYTHON OFF)
endif()
if(LKAO_BUILD_PYTHON)
  # Of the Python on PATH and the system's the first that has numpy, unless one is asked for.
  foreach(candidate IN ITEMS python3 /usr/bin/python3)
    if(Python_EXECUTABLE)
      break()
    endif()
    execute_process(COMMAND "${candidate}" -c "import numpy, sys; print(sys.executable)"
                    RESULT_VARIABLE status OUTPUT_VARIABLE found OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(status EQUAL 0)
      set(Python_EXECUTABLE "${found}" CACHE FILEPATH "The Python that the package lkao is for")
    endif()
  endforeach()
  find_package(Python 3.9 COMPONENTS Interpreter Development.Module QUIET)
  set(PYBIND11_NOPYTHON ON)
  find_package(pybind11 2.6 CONFIG QUIET)
  if(NOT Python_EXECUTABLE OR NOT Python_Development.Module_FOUND OR NOT pybind11_FOUND)
    message(STATUS "lkao: without the Python package, which needs python3-dev python3-numpy pybind11-dev")
    set(LKAO_BUILD_PYTHON OFF)
  endif()
endif()

if(LKAO_BUILD_TESTS)
  lkao_find(GTest "libgtest-dev;libgmock-dev" CONFIG)
endif()
if(LKAO_BUILD_BENCH)
  lkao_find(benchmark libbenchmark-dev CONFIG)
  lkao_find(ZLIB zlib1g-dev)
endif()

if(lkao_missing)
  list(REMOVE_DUPLICATES lkao_missing)
  list(JOIN lkao_missing " " lkao_missing)
  message(FATAL_ERROR "lkao needs libraries that were not found. On Debian or Ubuntu:\n"
                      "  sudo apt-get install --no-install-recommends ${lkao_missing}")
endif()
