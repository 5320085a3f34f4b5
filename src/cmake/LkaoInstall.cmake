# cmake --install: headers, libraries, the program, and the package for find_package(lkao CONFIG).

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(lkao_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/lkao")

# lkao_install(TARGET SET COMPONENT HEADER ...): one library with its part of the package and its public headers.
function(lkao_install TARGET SET COMPONENT)
  install(TARGETS ${TARGET} EXPORT ${SET} COMPONENT ${COMPONENT} INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
  install(EXPORT ${SET} NAMESPACE lkao:: DESTINATION "${lkao_package_dir}" COMPONENT ${COMPONENT})
  install(FILES ${ARGN} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/lkao" COMPONENT ${COMPONENT})
endfunction()

# Public headers by the library that they belong to.
set(lkao_headers "${PROJECT_SOURCE_DIR}/include/lkao")
file(GLOB lkao_lut_headers CONFIGURE_DEPENDS "${lkao_headers}/*.h")
set(lkao_cpu_headers "")
foreach(header IN ITEMS ambient_occlusion kernel lkao neighbourhood occluder_bvh)
  list(APPEND lkao_cpu_headers "${lkao_headers}/${header}.h")
endforeach()
list(REMOVE_ITEM lkao_lut_headers ${lkao_cpu_headers} "${lkao_headers}/gl.h")

lkao_install(lkao_lut lkaoLutTargets lkao_lut ${lkao_lut_headers})
if(LKAO_BUILD_CPU)
  lkao_install(lkao lkaoTargets lkao_core ${lkao_cpu_headers})
endif()
if(LKAO_BUILD_GL)
  lkao_install(lkao_gl lkaoGlTargets lkao_gl "${lkao_headers}/gl.h")
  install(DIRECTORY "${lkao_headers}/gl" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/lkao" COMPONENT lkao_gl)
endif()

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/lkaoConfig.cmake.in" "${PROJECT_BINARY_DIR}/lkaoConfig.cmake"
                              INSTALL_DESTINATION "${lkao_package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/lkaoConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/lkaoConfig.cmake" "${PROJECT_BINARY_DIR}/lkaoConfigVersion.cmake"
        DESTINATION "${lkao_package_dir}" COMPONENT lkao_lut)

if(TARGET lkao_cli)
  set(lkao_libraries "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
  set_target_properties(lkao_cli PROPERTIES INSTALL_RPATH "${lkao_libraries};${lkao_libraries}/lkao")
  install(TARGETS lkao_cli RUNTIME COMPONENT lkao_program)
  install(TARGETS lkao_image_codec LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/lkao" COMPONENT lkao_program)
endif()
