# How every source file of the project is compiled.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

if(PROJECT_IS_TOP_LEVEL)
  set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
  set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
  # Where programs find the shared object of src/image.
  set(CMAKE_BUILD_RPATH "$ORIGIN")
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release or RelWithDebInfo" FORCE)
  endif()
  find_program(LKAO_CCACHE ccache)
  if(LKAO_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER "${LKAO_CCACHE}")
  endif()
endif()

# No fused multiply-adds: the edge test of a triangle must be the exact negation of its neighbour's, and masks must be
# the same bits with every compiler.
if(MSVC)
  add_compile_options(/fp:precise /W4)
else()
  add_compile_options(-ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
  add_compile_options(-Wreserved-identifier -Wreserved-macro-identifier)
endif()
# GCC 12 takes concatenated std::strings for overlapping memory (GCC bug 105329).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  add_compile_options(-Wno-restrict)
endif()
# CMake's default, no build type, means no optimisation: kernels would be some thirty times slower, in silence.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES AND NOT MSVC)
  message(STATUS "lkao: CMAKE_BUILD_TYPE is not set: lkao itself is compiled with -O3")
  add_compile_options(-O3)
endif()
# Highway's targets for x86 are AVX-512, AVX2 and SSE4; a fourth copy of every kernel for the Core 2 of 2006 is left
# out. Under sanitizers copies take long to compile and to run: AVX-512 stays for the widest loads and stores, AVX2 for
# its own way to pack lanes (bvh/simd/lanes-inl.h). SSE4 has no line of its own, nor has Clang's emulation of vectors,
# which takes five times as long to compile as AVX2: as with GCC, the scalar kernel takes its place. Races are the same
# with any.
if(LKAO_SANITIZE STREQUAL "thread")
  add_compile_definitions("HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_SSE4|HWY_AVX3)" HWY_BROKEN_EMU128=1)
elseif(LKAO_SANITIZE AND NOT LKAO_SANITIZE MATCHES "fuzzer")
  add_compile_definitions("HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_SSE4)" HWY_BROKEN_EMU128=1)
else()
  add_compile_definitions(HWY_DISABLED_TARGETS=HWY_SSSE3)
endif()
# A third of the time to compile goes into making code fast, and under sanitizers more than half. lkao_cold is for what
# reads options, once; the others, empty elsewhere, are for what computes little beside the libraries.
if(NOT MSVC)
  set(lkao_cold "$<$<NOT:$<CONFIG:Debug>>:-O1>")
  if(LKAO_SANITIZE)
    set(lkao_cold -O0)
    set(lkao_cold_if_sanitized -O0)
  elseif(LKAO_QUICK_BUILD)
    set(lkao_cold -O0)
    set(lkao_cool_if_quick -O1)
  endif()
endif()
# Most of the time to compile a source goes into what it includes.
if(LKAO_UNITY_BUILD)
  set(CMAKE_UNITY_BUILD ON)
  set(CMAKE_UNITY_BUILD_BATCH_SIZE 40)
endif()
if(LKAO_WERROR)
  set(CMAKE_COMPILE_WARNING_AS_ERROR ON)
endif()
if(LKAO_SANITIZE)
  add_compile_options(-fsanitize=${LKAO_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${LKAO_SANITIZE})
  if(LKAO_SANITIZE MATCHES "address,undefined")
    # Takes a tenth of the time to compile, and sees less than the address sanitizer.
    add_compile_options(-fno-sanitize=object-size)
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    # The C++ library that a program in C stands on needs what Clang leaves out of such programs.
    add_link_options("$<$<LINK_LANGUAGE:C>:-fsanitize-link-c++-runtime;-lstdc++>")
  endif()
endif()
if(LKAO_SANITIZE STREQUAL "thread")
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "The thread sanitizer needs Clang: GCC cannot leave out the templates of oneTBB, and reports "
                        "races in them that are none (tests/tsan/ignorelist.txt)")
  endif()
  add_compile_options("-fsanitize-ignorelist=${PROJECT_SOURCE_DIR}/tests/tsan/ignorelist.txt")
  # Clang 14's sanitizer stops where the kernel randomises addresses too widely.
  execute_process(COMMAND setarch -R true RESULT_VARIABLE setarch_status OUTPUT_QUIET ERROR_QUIET)
  if(setarch_status EQUAL 0)
    set(CMAKE_CROSSCOMPILING_EMULATOR setarch -R)
  endif()
endif()
