# cmake -DBINARY=<build folder> -DCONFIG=<configuration> -DPREFIX=<folder> -DCOMPONENTS=<a,b> -P install.cmake
#
# Installs those components and nothing else.

file(REMOVE_RECURSE "${PREFIX}")
string(REPLACE "," ";" COMPONENTS "${COMPONENTS}")
foreach(component IN LISTS COMPONENTS)
  execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BINARY}" --config "${CONFIG}" --prefix "${PREFIX}"
                          --component ${component} RESULT_VARIABLE status OUTPUT_QUIET)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "cannot install ${component}")
  endif()
endforeach()
