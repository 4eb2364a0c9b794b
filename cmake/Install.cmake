# Installs libraries, headers, the tool, and what find_package(omma) reads.
include(CMakePackageConfigHelpers)

get_property(libraries GLOBAL PROPERTY OMMA_LIBRARIES)
set_target_properties(omma_options PROPERTIES EXPORT_NAME options)
install(TARGETS ${libraries} EXPORT omma-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/omma DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h" PATTERN "*.def")

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/omma)
install(EXPORT omma-targets NAMESPACE omma:: DESTINATION ${package_folder})
configure_package_config_file(
  ${PROJECT_SOURCE_DIR}/cmake/omma-config.cmake.in ${PROJECT_BINARY_DIR}/omma-config.cmake
  INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/omma-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/omma-config.cmake ${PROJECT_BINARY_DIR}/omma-config-version.cmake
        DESTINATION ${package_folder})
# Modules for dependencies whose own CMake package is missing or of no use.
install(FILES ${PROJECT_SOURCE_DIR}/cmake/FindByPkgConfig.cmake ${PROJECT_SOURCE_DIR}/cmake/Findepoxy.cmake
              ${PROJECT_SOURCE_DIR}/cmake/Findspng.cmake ${PROJECT_SOURCE_DIR}/cmake/FindWebP.cmake
        DESTINATION ${package_folder})

install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
