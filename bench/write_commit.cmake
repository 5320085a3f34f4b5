# Writes the header OUTPUT with the commit of the repository SOURCE_DIR as LKAO_COMMIT, empty where there is none. Run
# at each build: a commit does not make CMake configure again.
execute_process(COMMAND git describe --always --dirty --abbrev=12 "--exclude=*" WORKING_DIRECTORY "${SOURCE_DIR}"
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
set(header "#define LKAO_COMMIT \"${commit}\"\n")
if(EXISTS "${OUTPUT}")
  file(READ "${OUTPUT}" old_header)
endif()
# Only if it differs, so that nothing is compiled without need.
if(NOT header STREQUAL old_header)
  file(WRITE "${OUTPUT}" "${header}")
endif()
