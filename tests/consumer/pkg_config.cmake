# cmake -DCOMPILER=<compiler,flags> -DPREFIX=<install tree> -DMODULE=lkao -DSOURCE=main.cpp -DPROGRAM=<file>
#       -P pkg_config.cmake
#
# Compiles and links a program with what pkg-config says, and runs it.

file(GLOB_RECURSE pc "${PREFIX}/${MODULE}.pc")
cmake_path(GET pc PARENT_PATH folder)
set(ENV{PKG_CONFIG_PATH} "${folder}")
execute_process(COMMAND pkg-config --cflags --libs ${MODULE} ${ALSO} OUTPUT_VARIABLE flags COMMAND_ERROR_IS_FATAL ANY
                OUTPUT_STRIP_TRAILING_WHITESPACE)
separate_arguments(flags UNIX_COMMAND "${flags}")
cmake_path(GET folder PARENT_PATH libraries)
string(REPLACE "," ";" COMPILER "${COMPILER}")
execute_process(COMMAND ${COMPILER} -o "${PROGRAM}" "${SOURCE}" ${flags} "-Wl,-rpath,${libraries}"
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${PROGRAM}" COMMAND_ERROR_IS_FATAL ANY)
