# The package for Debian: `cpack` in a build folder of the preset "package".
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME sofof)
set(CPACK_PACKAGE_CONTACT "SOFOF maintainers <maintainers@sofof.invalid>" CACHE
  STRING "Who maintains the package: NAME <ADDRESS>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY
  "service-oriented function offloading for automated vehicles")
set(CPACK_PACKAGE_DESCRIPTION
  "Services of connected automated vehicles, trajectory planning among them, run
in the vehicle or at an edge server, as policies decide. Scenarios run in
virtual time, the same bytes for the same seed, or on the wall clock over TLS
between hosts. Sweeps, reports in the browser and a benchmark of policies are
included.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_CMAKE_PROJECTS "${PROJECT_BINARY_DIR};sofof;program;/")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON) # what is linked, with the versions it needs
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "bash-completion, wireshark")
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
  ${PROJECT_SOURCE_DIR}/packaging/deb/postinst
  ${PROJECT_SOURCE_DIR}/packaging/deb/prerm)
