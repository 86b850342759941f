# Tells find_package(CAF) where our patched CAF lies, and builds it if it is
# missing. -DSOFOF_CAF_PREFIX=FOLDER names another one.
set(SOFOF_CAF_PREFIX "$ENV{SOFOF_CAF_PREFIX}" CACHE PATH
  "Where CAF 0.18.7 is installed; empty: where cmake/caf/build.sh puts it")

set(sofof_caf_build bash ${CMAKE_CURRENT_LIST_DIR}/caf/build.sh)
set(sofof_caf_prefix "${SOFOF_CAF_PREFIX}")
if(NOT SOFOF_CAF_PREFIX)
  execute_process(COMMAND ${sofof_caf_build} --prefix
    OUTPUT_VARIABLE sofof_caf_prefix OUTPUT_STRIP_TRAILING_WHITESPACE
    COMMAND_ERROR_IS_FATAL ANY)
  if(NOT EXISTS "${sofof_caf_prefix}")
    message(STATUS "Building CAF into ${sofof_caf_prefix}, once: some minutes")
    execute_process(COMMAND ${sofof_caf_build} COMMAND_ERROR_IS_FATAL ANY)
  endif()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
    ${CMAKE_CURRENT_LIST_DIR}/caf/build.sh
    ${CMAKE_CURRENT_LIST_DIR}/caf/caf-0.18.7-sofof.patch)
endif()

# Forced: a cached CAF_DIR would outlive a changed prefix.
set(CAF_DIR "${sofof_caf_prefix}/lib/cmake/CAF" CACHE PATH
  "Set by sofof_caf.cmake" FORCE)
