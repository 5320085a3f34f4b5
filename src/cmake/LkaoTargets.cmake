# The kinds of targets of this project.

# Include roots: "lkao/file.h" is public; "lut/file.h", "bvh/file.h", "gpu/file.h" and "scene/file.h" ... are internal.
set(lkao_include_roots "${PROJECT_SOURCE_DIR}/include" "${PROJECT_SOURCE_DIR}" "${PROJECT_SOURCE_DIR}/src")

# Of lkao's own sources, static libraries and objects: only what LKAO_API marks is seen from outside of a shared object.
set(lkao_hidden CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
set(lkao_shared_definitions "$<$<BOOL:${BUILD_SHARED_LIBS}>:LKAO_SHARED;LKAO_BUILDING>")

# lkao_public_library(TARGET NAME [OBJECTS] SOURCES a.cpp ... LKAO lkao_lut ... LINKS x ...)
#   A library that is installed as lkao::NAME. TARGET is always a static one, for the program and the tests, which see
#   all its names. With BUILD_SHARED_LIBS, lkao::NAME is TARGET_shared, of the same objects. LKAO: the public libraries
#   it stands on; LINKS: external libraries that its headers do not show. OBJECTS: without sources of its own;
#   lkao_core_part adds objects.
function(lkao_public_library TARGET NAME)
  cmake_parse_arguments(PARSE_ARGV 2 library "OBJECTS" "" "SOURCES;LKAO;LINKS")
  add_library(${TARGET} STATIC ${library_SOURCES})
  set_target_properties(${TARGET} PROPERTIES ${lkao_hidden})
  target_compile_definitions(${TARGET} PRIVATE ${lkao_shared_definitions})
  target_link_libraries(${TARGET} PUBLIC ${library_LKAO})
  set(published ${TARGET})
  if(BUILD_SHARED_LIBS)
    set(published ${TARGET}_shared)
    add_library(${published} SHARED)
    if(NOT library_OBJECTS)
      target_sources(${published} PRIVATE $<TARGET_OBJECTS:${TARGET}>)
    endif()
    target_compile_definitions(${published} INTERFACE LKAO_SHARED)
    list(TRANSFORM library_LKAO APPEND _shared)
    target_link_libraries(${published} PUBLIC ${library_LKAO})
    # What is missing in the libraries it stands on is seen here and not by its first user.
    target_link_options(${published} PRIVATE $<$<PLATFORM_ID:Linux>:LINKER:--no-undefined>)
  endif()
  add_library(lkao::${NAME} ALIAS ${published})
  foreach(target IN ITEMS ${TARGET} ${published})
    target_compile_features(${target} PUBLIC cxx_std_20)
    target_include_directories(${target} PUBLIC "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>"
                                         PRIVATE ${lkao_include_roots})
    target_link_libraries(${target} PUBLIC glm::glm PRIVATE ${library_LINKS})
    # Before 1.0 each minor version is a library of its own.
    set_target_properties(${target} PROPERTIES
                          LINKER_LANGUAGE CXX OUTPUT_NAME ${TARGET} EXPORT_NAME ${NAME} VERSION ${PROJECT_VERSION}
                          SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  endforeach()
endfunction()

# lkao_core_part(NAME SOURCES a.cpp ... LINKS x ...)
#   One floor of the core library, an object library lkao_NAME whose objects go into lkao. LINKS: the lower parts
#   (lkao_bvh ...) it stands on, and external libraries, which lkao then links privately.
function(lkao_core_part NAME)
  cmake_parse_arguments(PARSE_ARGV 1 part "" "" "SOURCES;LINKS")
  add_library(lkao_${NAME} OBJECT ${part_SOURCES})
  set_target_properties(lkao_${NAME} PROPERTIES ${lkao_hidden})
  target_compile_definitions(lkao_${NAME} PRIVATE ${lkao_shared_definitions})
  target_include_directories(lkao_${NAME} PUBLIC ${lkao_include_roots})
  target_link_libraries(lkao_${NAME} PUBLIC glm::glm ${part_LINKS})
  list(FILTER part_LINKS EXCLUDE REGEX "^lkao_")
  foreach(target IN ITEMS lkao lkao_shared)
    if(TARGET ${target})
      target_sources(${target} PRIVATE $<TARGET_OBJECTS:lkao_${NAME}>)
      target_link_libraries(${target} PRIVATE ${part_LINKS})
    endif()
  endforeach()
endfunction()

# lkao_compile_alone(a.cpp ...)
#   With LKAO_UNITY_BUILD all other sources of a target are compiled as one. These cannot: Highway includes them again
#   for each instruction set, or they must not see what another includes.
function(lkao_compile_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# lkao_precompile(TARGET header ...)
#   Headers that several targets include, read once. With LKAO_UNITY_BUILD only, as it hides what a source forgot to
#   include.
function(lkao_precompile TARGET)
  if(LKAO_UNITY_BUILD)
    target_precompile_headers(${TARGET} PRIVATE ${ARGN})
  endif()
endfunction()

# lkao_precompile_as(TARGET OTHER)
#   What was read for OTHER, which must be compiled with the same options and definitions.
function(lkao_precompile_as TARGET OTHER)
  if(LKAO_UNITY_BUILD)
    target_precompile_headers(${TARGET} REUSE_FROM ${OTHER})
  endif()
endfunction()

# lkao_module(NAME SOURCES a.cpp ... LINKS x ...)
#   A static library lkao_NAME beside the core, for the program and the tests; not installed. LINKS are public.
function(lkao_module NAME)
  cmake_parse_arguments(PARSE_ARGV 1 module "" "" "SOURCES;LINKS")
  add_library(lkao_${NAME} STATIC ${module_SOURCES})
  target_include_directories(lkao_${NAME} PUBLIC ${lkao_include_roots})
  target_link_libraries(lkao_${NAME} PUBLIC ${module_LINKS})
endfunction()

# lkao_compile_only(TARGET ...)
#   For what a build with sanitizers does not run: the sources are compiled, for the compiler's warnings alone and so
#   without sanitizers; the programs are not linked.
function(lkao_compile_only)
  foreach(target IN LISTS ARGN)
    get_target_property(type ${target} TYPE)
    if(type STREQUAL "EXECUTABLE" OR type STREQUAL "OBJECT_LIBRARY")
      target_compile_options(${target} PRIVATE -O0 -g0 -fno-sanitize=all)
    endif()
    if(type STREQUAL "EXECUTABLE")
      set_target_properties(${target} PROPERTIES EXCLUDE_FROM_ALL ON)
      add_custom_target(${target}_compiles ALL DEPENDS $<TARGET_OBJECTS:${target}>)
    endif()
  endforeach()
endfunction()

# Half of the time to compile a test goes into making its few instructions fast.
set(lkao_test_options -O1)
if(LKAO_SANITIZE)
  set(lkao_test_options -O0)
endif()

# lkao_test(NAME [HOT] SOURCES a.cpp ... LINKS x ... [LABELS slow|tsan ...] [READS path ...] [COST seconds])
#   A GoogleTest program lkao_test_NAME, each of its tests known to CTest. Tests with the label "slow" are left out
#   under AddressSanitizer; those with "tsan" are what ThreadSanitizer runs (target lkao_tsan_tests; see tests/tsan).
#   READS: the programs that the tests start, the files and folders that they read: `./run test` repeats tests that
#   passed when one of these changes. COST: about how long they take, where that is long: these are run first. HOT: they
#   compute much by themselves, and are optimised under sanitizers too, without the others' headers.
function(lkao_test NAME)
  cmake_parse_arguments(PARSE_ARGV 1 test "HOT" "COST" "SOURCES;LINKS;LABELS;READS")
  add_executable(lkao_test_${NAME} ${test_SOURCES})
  target_include_directories(lkao_test_${NAME} PRIVATE ${lkao_include_roots} "${PROJECT_SOURCE_DIR}/tests")
  target_compile_definitions(lkao_test_${NAME} PRIVATE "LKAO_SHARED_DIR=\"${LKAO_SHARED_DIR}\"")
  target_link_libraries(lkao_test_${NAME} PRIVATE ${test_LINKS} GTest::gmock GTest::gtest GTest::gtest_main)
  set(options ${lkao_test_options})
  if(LKAO_SANITIZE AND test_HOT)
    set(options -O1)
  endif()
  target_compile_options(lkao_test_${NAME} PRIVATE ${options})
  if(LKAO_SANITIZE AND "lkao" IN_LIST test_LINKS)
    # Of an inline function that several objects have the first is linked: not the unoptimised one of a test.
    target_link_options(lkao_test_${NAME} PRIVATE
      "LINKER:--whole-archive,$<TARGET_FILE:lkao>,$<TARGET_FILE:lkao_lut>,--no-whole-archive")
  endif()
  if(LKAO_SANITIZE AND "slow" IN_LIST test_LABELS)
    lkao_compile_only(lkao_test_${NAME})
    return()
  endif()
  if(options STREQUAL lkao_test_options)
    lkao_precompile_as(lkao_test_${NAME} lkao_test_headers)
  endif()
  if(test_READS)
    list(JOIN test_READS "\n" reads)
    file(GENERATE OUTPUT "$<TARGET_FILE:lkao_test_${NAME}>.reads" CONTENT "${reads}")
  endif()

  set(properties TIMEOUT 900)
  if(test_LABELS)
    list(APPEND properties LABELS "${test_LABELS}")
  endif()
  if(NOT test_COST AND "slow" IN_LIST test_LABELS)
    set(test_COST 100)
  endif()
  if(test_COST)
    list(APPEND properties COST ${test_COST})
  endif()
  if("tsan" IN_LIST test_LABELS)
    list(APPEND properties ENVIRONMENT
         "TSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/tsan/suppressions.txt")
    add_dependencies(lkao_tsan_tests lkao_test_${NAME})
  endif()
  if(LKAO_SANITIZE MATCHES "address")
    # Clang 14's leak check crashes, now and then, in the variables of threads of a program with many libraries.
    list(APPEND properties ENVIRONMENT
         "LSAN_OPTIONS=use_tls=0:print_suppressions=0:suppressions=${PROJECT_SOURCE_DIR}/tests/asan/leak_suppressions.txt")
  endif()
  gtest_discover_tests(lkao_test_${NAME} DISCOVERY_TIMEOUT 60 PROPERTIES ${properties})
endfunction()

# lkao_test_starts(NAME PROGRAM)
#   The tests lkao_test_NAME start the target PROGRAM, LKAO_PROGRAM in their sources: it is made before they are linked,
#   and not, as with add_dependencies, before they are compiled.
function(lkao_test_starts NAME PROGRAM)
  target_compile_definitions(lkao_test_${NAME} PRIVATE "LKAO_PROGRAM=\"$<TARGET_FILE:${PROGRAM}>\"")
  set_target_properties(lkao_test_${NAME} PROPERTIES LINK_DEPENDS $<TARGET_FILE:${PROGRAM}>)
endfunction()
