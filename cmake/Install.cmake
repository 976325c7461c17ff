# Installs tetsoup so that find_package(tetsoup) gives tetsoup::tetsoup, and COMPONENTS io also tetsoup::io.
# Two export sets, since only the second needs libpng, tinygltf and libwebp. The install component `tetsoup_development` holds
# libraries, headers and package files without the tool.
include(CMakePackageConfigHelpers)

set(tetsoup_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/tetsoup)

# tetsoup_install_library(target export_set): library, public headers, and the file that describes them to CMake.
function(tetsoup_install_library target export_set)
  install(TARGETS ${target} EXPORT ${export_set}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT tetsoup_development
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT tetsoup_development
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tetsoup_development
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT tetsoup_development)
  install(EXPORT ${export_set} NAMESPACE tetsoup:: DESTINATION ${tetsoup_package_dir} COMPONENT tetsoup_development)
endfunction()

tetsoup_install_library(tetsoup tetsoup-targets)
if(TETSOUP_IO)
  tetsoup_install_library(tetsoup_io tetsoup-io-targets)
  install(FILES cmake/FindWebP.cmake DESTINATION ${tetsoup_package_dir} COMPONENT tetsoup_development)
endif()

configure_package_config_file(cmake/tetsoup-config.cmake.in ${PROJECT_BINARY_DIR}/tetsoup-config.cmake
  INSTALL_DESTINATION ${tetsoup_package_dir} NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tetsoup-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tetsoup-config.cmake ${PROJECT_BINARY_DIR}/tetsoup-config-version.cmake
  DESTINATION ${tetsoup_package_dir} COMPONENT tetsoup_development)
