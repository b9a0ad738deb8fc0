# What is installed: the program with its manual; for C++ programs (component development) the rooms as libraries; a package of Debian.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(CODE "
  set(share \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}\")
  execute_process(COMMAND $<TARGET_FILE:gonio> manual \"\${share}\" COMMAND_ERROR_IS_FATAL ANY)
  if(CMAKE_INSTALL_PREFIX STREQUAL /usr AND EXISTS /etc/debian_version)  # whose zsh looks for a package's words there
    file(RENAME \"\${share}/zsh/site-functions\" \"\${share}/zsh/vendor-completions\")
  endif()" COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/CITATION.cff
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

set(config ${CMAKE_INSTALL_LIBDIR}/cmake/gonio)
install(EXPORT gonio NAMESPACE gonio:: FILE gonioTargets.cmake DESTINATION ${config} COMPONENT development)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/gonioConfig.cmake.in ${PROJECT_BINARY_DIR}/gonioConfig.cmake
  INSTALL_DESTINATION ${config})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/gonioConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/gonioConfig.cmake ${PROJECT_BINARY_DIR}/gonioConfigVersion.cmake
  DESTINATION ${config} COMPONENT development)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The authors of gonio <gonio@example.org>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME gonio)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
include(CPack)
