# cmake --install: headers, libraries, the program, and the package for find_package(lkao CONFIG).

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(lkao_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/lkao")

install(TARGETS lkao EXPORT lkaoTargets COMPONENT lkao_core INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(EXPORT lkaoTargets NAMESPACE lkao:: DESTINATION "${lkao_package_dir}" COMPONENT lkao_core)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/lkao" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT lkao_core
        FILES_MATCHING PATTERN "*.h" PATTERN "gl.h" EXCLUDE)

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/lkaoConfig.cmake.in" "${PROJECT_BINARY_DIR}/lkaoConfig.cmake"
                              INSTALL_DESTINATION "${lkao_package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/lkaoConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/lkaoConfig.cmake" "${PROJECT_BINARY_DIR}/lkaoConfigVersion.cmake"
        DESTINATION "${lkao_package_dir}" COMPONENT lkao_core)

# A package component of its own, so that who links lkao::lkao alone needs nothing of OpenGL.
if(LKAO_BUILD_GL)
  install(TARGETS lkao_gl EXPORT lkaoGlTargets COMPONENT lkao_gl INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
  install(EXPORT lkaoGlTargets NAMESPACE lkao:: DESTINATION "${lkao_package_dir}" COMPONENT lkao_gl)
  install(FILES "${PROJECT_SOURCE_DIR}/include/lkao/gl.h" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/lkao"
          COMPONENT lkao_gl)
endif()

if(TARGET lkao_cli)
  set(lkao_libraries "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
  set_target_properties(lkao_cli PROPERTIES INSTALL_RPATH "${lkao_libraries};${lkao_libraries}/lkao")
  install(TARGETS lkao_cli RUNTIME COMPONENT lkao_program)
  install(TARGETS lkao_image_codec LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/lkao" COMPONENT lkao_program)
endif()
