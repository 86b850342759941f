# What `cmake --install` puts where. Component "program": the program with
# scenarios, schemas, completion, manual and units; "development", as a package
# `sofof`: the libraries that need no actors, sofof::offloading,
# sofof::messages, sofof::policies, sofof::planners, and what they stand on.
include(CMakePackageConfigHelpers)

set(sofof_installed base world messages policies planners offloading)
foreach(folder ${sofof_installed})
  set_target_properties(sofof_${folder} PROPERTIES EXPORT_NAME ${folder})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder}
    DESTINATION include/sofof
    COMPONENT development
    FILES_MATCHING PATTERN "*.hpp"
    # Of the actors.
    PATTERN interfaces.hpp EXCLUDE
    PATTERN inspector_access.hpp EXCLUDE
    PATTERN type_ids.hpp EXCLUDE
    PATTERN admission.hpp EXCLUDE)
endforeach()
set_target_properties(sofof_options PROPERTIES EXPORT_NAME options)

list(TRANSFORM sofof_installed PREPEND sofof_ OUTPUT_VARIABLE targets)
install(TARGETS sofof_options ${targets} EXPORT sofof_targets
  ARCHIVE DESTINATION lib COMPONENT development)
install(EXPORT sofof_targets FILE sofof-targets.cmake NAMESPACE sofof::
  DESTINATION lib/cmake/sofof COMPONENT development)

file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/sofof-config.cmake CONTENT [[
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 NO_MODULE)
find_dependency(fmt)
find_dependency(tomlplusplus)
find_dependency(nlohmann_json)
list(APPEND CMAKE_MODULE_PATH /usr/share/cmake/geographiclib)
find_dependency(GeographicLib)
include(${CMAKE_CURRENT_LIST_DIR}/sofof-targets.cmake)
]] @ONLY)
write_basic_package_version_file(
  ${PROJECT_BINARY_DIR}/sofof-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/sofof-config.cmake
  ${PROJECT_BINARY_DIR}/sofof-config-version.cmake
  DESTINATION lib/cmake/sofof COMPONENT development)

install(TARGETS sofof_cli RUNTIME DESTINATION bin COMPONENT program)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/config DESTINATION share/sofof
  COMPONENT program)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples
  ${PROJECT_SOURCE_DIR}/packaging/kubernetes ${PROJECT_SOURCE_DIR}/packaging/slurm
  DESTINATION share/doc/sofof COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/packaging/systemd/sofof.sysusers
  DESTINATION lib/sysusers.d RENAME sofof.conf COMPONENT program)
install(CODE "
  set(program $<TARGET_FILE:sofof_cli>)
  set(source ${PROJECT_SOURCE_DIR})
  set(caf_licence ${sofof_caf_prefix}/share/doc/caf/LICENSE)
  set(proton ${sofof_proton_package})
  set(package_version ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
  set(maintainer \"${CPACK_PACKAGE_CONTACT}\")
  include(${PROJECT_SOURCE_DIR}/cmake/install_made.cmake)
" COMPONENT program)
