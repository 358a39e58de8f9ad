# make install: command, library, headers, CMake package and pkg-config file.
include(CMakePackageConfigHelpers)
install(TARGETS clast_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS clast EXPORT clastTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
# The archive is a component of its own: only who links it needs the packages that clast was built with.
install(TARGETS clast_static EXPORT clastStaticTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT clastStaticTargets NAMESPACE clast:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/clast)
install(DIRECTORY include/clast DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT clastTargets NAMESPACE clast:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/clast)
set(CLAST_PRIVATE_MODULES cairo jansson yaml-0.1 qhull_r lapacke zlib)
set(CLAST_PRIVATE_LIBS ${HDF5_C_LIBRARIES} m pthread)
if(CLAST_HAVE_SUNDIALS)
  list(APPEND CLAST_PRIVATE_LIBS ${SUNDIALS_CVODE})
endif()
if(TARGET OpenMP::OpenMP_C)
  list(APPEND CLAST_PRIVATE_LIBS ${OpenMP_C_FLAGS})
endif()
list(TRANSFORM CLAST_PRIVATE_LIBS REPLACE "^([^/-].*)$" "-l\\1" OUTPUT_VARIABLE private)
list(JOIN private " " CLAST_PC_LIBS_PRIVATE)
list(JOIN CLAST_PRIVATE_MODULES " " CLAST_PC_REQUIRES_PRIVATE)
option(CLAST_PC_RPATH "clast.pc: programs find libclast.so where it lies (OFF: by ldconfig or LD_LIBRARY_PATH alone)" ON)
set(CLAST_PC_RUN_PATH)
if(CLAST_PC_RPATH)
  set(CLAST_PC_RUN_PATH " -Wl,-rpath,\${libdir}")
endif()
configure_file(cmake/clastConfig.cmake.in ${PROJECT_BINARY_DIR}/clastConfig.cmake @ONLY)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/clastConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/clastConfig.cmake ${PROJECT_BINARY_DIR}/clastConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/clast)
# the .pc files find their prefix from where they lie, so that cmake --install --prefix works
file(RELATIVE_PATH CLAST_PC_UP /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
configure_file(cmake/clast.pc.in ${PROJECT_BINARY_DIR}/clast.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/clast.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
if(TARGET clast_mpi)
  install(TARGETS clast_mpi_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(TARGETS clast_mpi EXPORT clastMpiTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT clastMpiTargets NAMESPACE clast:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/clast)
  configure_file(cmake/clast-mpi.pc.in ${PROJECT_BINARY_DIR}/clast-mpi.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/clast-mpi.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endif()

# Manual page and completions come from the command's own option tables.
set(MADE ${PROJECT_BINARY_DIR}/generated)
add_custom_command(OUTPUT ${MADE}/clast.1 ${MADE}/clast.bash ${MADE}/_clast
  COMMAND clast_cli man > ${MADE}/clast.1
  COMMAND clast_cli completion > ${MADE}/clast.bash
  COMMAND clast_cli completion --shell zsh > ${MADE}/_clast
  DEPENDS clast_cli VERBATIM)
add_custom_target(clast_pages ALL DEPENDS ${MADE}/clast.1 ${MADE}/clast.bash ${MADE}/_clast)
install(FILES ${MADE}/clast.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${MADE}/clast.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME clast)
install(FILES ${MADE}/_clast DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
