# cmake -DBINARY=<build folder> -DCONFIG=<configuration> -DPACKAGES=<folder> -DCPACK=<cpack> -DVERSION=<x.y.z>
#       -P packages.cmake
#
# Makes Debian's packages in the folder, checks what they hold and need, and unpacks them into PACKAGES/root.

file(REMOVE_RECURSE "${PACKAGES}")
file(MAKE_DIRECTORY "${PACKAGES}/root")
execute_process(COMMAND "${CPACK}" -G DEB -C "${CONFIG}" --config "${BINARY}/CPackConfig.cmake" -B "${PACKAGES}"
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)

# expect(PACKAGE FILE DEPENDS): there is that package, it has a file like that, and it depends on something like that.
function(expect PACKAGE FILE DEPENDS)
  file(GLOB package "${PACKAGES}/${PACKAGE}_${VERSION}*.deb")
  if(NOT package)
    message(FATAL_ERROR "no package ${PACKAGE}")
  endif()
  execute_process(COMMAND dpkg-deb -c "${package}" OUTPUT_VARIABLE content COMMAND_ERROR_IS_FATAL ANY)
  foreach(file IN ITEMS "${FILE}" "/usr/share/doc/${PACKAGE}/copyright")
    if(NOT content MATCHES "${file}")
      message(FATAL_ERROR "${PACKAGE} has no ${file}:\n${content}")
    endif()
  endforeach()
  execute_process(COMMAND dpkg-deb -f "${package}" Depends OUTPUT_VARIABLE depends COMMAND_ERROR_IS_FATAL ANY)
  if(NOT depends MATCHES "${DEPENDS}")
    message(FATAL_ERROR "${PACKAGE} depends on ${depends}and not on ${DEPENDS}")
  endif()
  execute_process(COMMAND dpkg-deb -x "${package}" "${PACKAGES}/root" COMMAND_ERROR_IS_FATAL ANY)
endfunction()

string(REGEX REPLACE "\\.[0-9]+$" "" abi "${VERSION}")
expect(liblkao${abi} "/liblkao\\.so\\.${abi} " "libtbb12")
expect(liblkao-gl${abi} "/liblkao_gl\\.so\\.${abi} " "liblkao${abi} \\(= ${VERSION}\\)")
file(GLOB c_package "${PACKAGES}/liblkao-c[0-9]*.deb")
if(c_package)
  string(REGEX REPLACE "^.*/liblkao-c([0-9]+)_.*$" "\\1" c_abi "${c_package}")
  expect(liblkao-c${c_abi} "/liblkao_c\\.so\\.${c_abi} " "libtbb12")
endif()
expect(liblkao-dev "/usr/include/lkao/lkao\\.h" "liblkao${abi} \\(= ${VERSION}\\)")
expect(lkao "/usr/bin/lkao" "libembree")
execute_process(COMMAND "${PACKAGES}/root/usr/bin/lkao" info builtin:wall OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
