# cmake --install: headers, libraries, the program, and what find_package(lkao CONFIG) and pkg-config read.
#
# Components: lkao_lut, lkao_core, lkao_gl, lkao_c: what programs are built with; lkao_runtime, lkao_gl_runtime: the
# libraries of a shared lkao alone; lkao_c_runtime: that of the C interface; lkao_program; lkao_python.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(lkao_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/lkao")
set(lkao_pkg_config_dir "${CMAKE_INSTALL_LIBDIR}/pkgconfig")

# lkao_install(TARGET SET COMPONENT RUNTIME HEADER ...): one library with its part of the package, and public headers.
function(lkao_install TARGET SET COMPONENT RUNTIME)
  if(TARGET ${TARGET}_shared)
    set(TARGET ${TARGET}_shared)
  endif()
  install(TARGETS ${TARGET} EXPORT ${SET}
          LIBRARY COMPONENT ${RUNTIME} NAMELINK_COMPONENT ${COMPONENT}
          RUNTIME COMPONENT ${RUNTIME}
          ARCHIVE COMPONENT ${COMPONENT}
          INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
  install(EXPORT ${SET} NAMESPACE lkao:: DESTINATION "${lkao_package_dir}" COMPONENT ${COMPONENT})
  install(FILES ${ARGN} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/lkao" COMPONENT ${COMPONENT})
endfunction()

# lkao_install_pc(NAME COMPONENT DESCRIPTION LIBRARY REQUIRES PRIVATE_REQUIRES): NAME.pc for pkg-config. What a
# shared library needs for itself, its users need not have.
function(lkao_install_pc NAME COMPONENT DESCRIPTION LIBRARY REQUIRES PRIVATE_REQUIRES)
  set(flags "")
  if(BUILD_SHARED_LIBS)
    set(flags -DLKAO_SHARED)
  else()
    string(APPEND REQUIRES " ${PRIVATE_REQUIRES}")
  endif()
  cmake_path(RELATIVE_PATH CMAKE_INSTALL_FULL_LIBDIR BASE_DIRECTORY "${CMAKE_INSTALL_PREFIX}/${lkao_pkg_config_dir}"
             OUTPUT_VARIABLE libraries)
  cmake_path(RELATIVE_PATH CMAKE_INSTALL_FULL_INCLUDEDIR
             BASE_DIRECTORY "${CMAKE_INSTALL_PREFIX}/${lkao_pkg_config_dir}" OUTPUT_VARIABLE headers)
  file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/${NAME}.pc" CONTENT [[
libdir=${pcfiledir}/@libraries@
includedir=${pcfiledir}/@headers@

Name: @NAME@
Description: @DESCRIPTION@
Version: @PROJECT_VERSION@
Requires: @REQUIRES@
Cflags: -I${includedir} @flags@
Libs: -L${libdir} -l@LIBRARY@
]] @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/${NAME}.pc" DESTINATION "${lkao_pkg_config_dir}" COMPONENT ${COMPONENT})
endfunction()

# Public headers by the library that they belong to.
set(lkao_headers "${PROJECT_SOURCE_DIR}/include/lkao")
file(GLOB lkao_lut_headers CONFIGURE_DEPENDS "${lkao_headers}/*.h")
set(lkao_cpu_headers "")
foreach(header IN ITEMS ambient_occlusion kernel lkao neighbourhood occluder_bvh occluder_scene ray_bundles
               sky_visibility soft_shadows)
  list(APPEND lkao_cpu_headers "${lkao_headers}/${header}.h")
endforeach()
list(REMOVE_ITEM lkao_lut_headers ${lkao_cpu_headers} "${lkao_headers}/gl.h" "${lkao_headers}/c.h")

lkao_install(lkao_lut lkaoLutTargets lkao_lut lkao_runtime ${lkao_lut_headers})
lkao_install_pc(lkao-lut lkao_lut "Sample patterns and plane mask tables of ambient occlusion" lkao_lut glm libhwy)
if(LKAO_BUILD_CPU)
  lkao_install(lkao lkaoTargets lkao_core lkao_runtime ${lkao_cpu_headers})
  lkao_install_pc(lkao lkao_core "${PROJECT_DESCRIPTION}" lkao lkao-lut "tbb libhwy")
endif()
if(LKAO_BUILD_GL)
  lkao_install(lkao_gl lkaoGlTargets lkao_gl lkao_gl_runtime "${lkao_headers}/gl.h")
  install(DIRECTORY "${lkao_headers}/gl" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/lkao" COMPONENT lkao_gl)
  lkao_install_pc(lkao-gl lkao_gl "${PROJECT_DESCRIPTION}, as an OpenGL pass" lkao_gl lkao-lut "epoxy egl")
endif()
if(LKAO_BUILD_CPU AND LKAO_BUILD_C)
  # All that the library needs is inside of it or linked, however lkao is built: a program needs it and its headers.
  lkao_install(lkao_c lkaoCTargets lkao_c lkao_c_runtime "${lkao_headers}/c.h")
  install(DIRECTORY "${lkao_headers}/c" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/lkao" COMPONENT lkao_c)
  install(FILES "${lkao_headers}/version_numbers.h" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/lkao" COMPONENT lkao_c)
  lkao_install_pc(lkao-c lkao_c "${PROJECT_DESCRIPTION}, for C" lkao_c "" "")
endif()

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/lkaoConfig.cmake.in" "${PROJECT_BINARY_DIR}/lkaoConfig.cmake"
                              INSTALL_DESTINATION "${lkao_package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/lkaoConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/lkaoConfig.cmake" "${PROJECT_BINARY_DIR}/lkaoConfigVersion.cmake"
        DESTINATION "${lkao_package_dir}" COMPONENT lkao_lut)

if(TARGET lkao_cli)
  set(lkao_libraries "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
  set_target_properties(lkao_cli PROPERTIES INSTALL_RPATH "${lkao_libraries}/lkao")
  install(TARGETS lkao_cli RUNTIME COMPONENT lkao_program)
  install(TARGETS lkao_image_codec LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/lkao" COMPONENT lkao_program)
endif()

if(TARGET lkao_python)
  # Where that Python looks by itself, as far as that is in the folder to install to.
  execute_process(COMMAND "${Python_EXECUTABLE}" -E "${CMAKE_CURRENT_LIST_DIR}/python_folder.py"
                          "${CMAKE_INSTALL_PREFIX}"
                  OUTPUT_VARIABLE lkao_python_folder OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  set(LKAO_PYTHON_DIR "${lkao_python_folder}" CACHE STRING "Where the Python package is installed, below the prefix")
  install(TARGETS lkao_python lkao_image_codec LIBRARY DESTINATION "${LKAO_PYTHON_DIR}/lkao" COMPONENT lkao_python)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/src/python/lkao" DESTINATION "${LKAO_PYTHON_DIR}" COMPONENT lkao_python
          FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN py.typed PATTERN __pycache__ EXCLUDE
                         PATTERN .mypy_cache EXCLUDE)
endif()

install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT lkao_lut)

if(PROJECT_IS_TOP_LEVEL)
  add_custom_target(uninstall
    COMMAND "${CMAKE_COMMAND}" "-DMANIFESTS=${PROJECT_BINARY_DIR}" -P "${CMAKE_CURRENT_LIST_DIR}/uninstall.cmake"
    COMMENT "Removing what was installed from this folder last"
    VERBATIM)
endif()
