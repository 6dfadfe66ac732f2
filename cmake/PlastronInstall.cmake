# What `cmake --install` leaves: programs, static libraries with their headers, and a CMake package that finds what they need.
include(CMakePackageConfigHelpers)
set(plastron_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Plastron)
install(EXPORT PlastronTargets NAMESPACE Plastron:: DESTINATION ${plastron_package_dir})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/PlastronConfig.cmake.in ${PROJECT_BINARY_DIR}/PlastronConfig.cmake
                              INSTALL_DESTINATION ${plastron_package_dir})
# Before version 1 a minor version may change anything.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/PlastronConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/PlastronConfig.cmake ${PROJECT_BINARY_DIR}/PlastronConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/PlastronDependencies.cmake
        DESTINATION ${plastron_package_dir})
