# make install: command, library, headers, CMake package and pkg-config file.
include(CMakePackageConfigHelpers)
install(TARGETS clast_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS clast EXPORT clastTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/clast DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT clastTargets NAMESPACE clast:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/clast)
file(WRITE ${CMAKE_BINARY_DIR}/clastConfig.cmake "include(\"\${CMAKE_CURRENT_LIST_DIR}/clastTargets.cmake\")\n")
write_basic_package_version_file(${CMAKE_BINARY_DIR}/clastConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${CMAKE_BINARY_DIR}/clastConfig.cmake ${CMAKE_BINARY_DIR}/clastConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/clast)
configure_file(cmake/clast.pc.in ${CMAKE_BINARY_DIR}/clast.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/clast.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
