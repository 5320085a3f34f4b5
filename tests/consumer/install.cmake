# cmake -DBINARY=<build folder> -DCONFIG=<configuration> -DPREFIX=<folder> -DCOMPONENTS=<a,b> -P install.cmake
#
# Installs those components and nothing else, elsewhere, and moves all of it to the folder.

file(REMOVE_RECURSE "${PREFIX}" "${PREFIX}.before")
string(REPLACE "," ";" COMPONENTS "${COMPONENTS}")
foreach(component IN LISTS COMPONENTS)
  execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BINARY}" --config "${CONFIG}" --prefix "${PREFIX}.before"
                          --component ${component} RESULT_VARIABLE status OUTPUT_QUIET)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "cannot install ${component}")
  endif()
endforeach()
file(RENAME "${PREFIX}.before" "${PREFIX}")
