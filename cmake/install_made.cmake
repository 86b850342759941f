# Installs what the program says of itself: schemas, completion, the manual; and
# units with the paths of this installation. It runs then, with `program`,
# `source`, `caf_licence`, `proton` (its package, or nothing), `package_version`
# and `maintainer` set.
set(root "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}")

# made(FILE WORDS...): what the program prints for the words becomes FILE.
function(made file)
  cmake_path(GET file PARENT_PATH folder)
  file(MAKE_DIRECTORY ${root}/${folder})
  execute_process(COMMAND ${program} ${ARGN} OUTPUT_FILE ${root}/${file}
    COMMAND_ERROR_IS_FATAL ANY)
  message(STATUS "Installing: ${root}/${file}")
  list(APPEND CMAKE_INSTALL_MANIFEST_FILES ${CMAKE_INSTALL_PREFIX}/${file})
  set(CMAKE_INSTALL_MANIFEST_FILES ${CMAKE_INSTALL_MANIFEST_FILES} PARENT_SCOPE)
endfunction()

foreach(kind scenario map sweep entrants)
  made(share/sofof/schemas/${kind}.json schema ${kind})
endforeach()
made(share/bash-completion/completions/sofof completion bash)
made(share/zsh/vendor-completions/_sofof completion zsh)
made(share/man/man1/sofof.1 manual)
execute_process(COMMAND gzip -9nf ${root}/share/man/man1/sofof.1
  COMMAND_ERROR_IS_FATAL ANY)
list(TRANSFORM CMAKE_INSTALL_MANIFEST_FILES REPLACE "/sofof\\.1$" "/sofof.1.gz")

set(bin ${CMAKE_INSTALL_PREFIX}/bin)
set(share ${CMAKE_INSTALL_PREFIX}/share)
set(units ${CMAKE_INSTALL_PREFIX}/lib/systemd/system)
if(CMAKE_INSTALL_PREFIX STREQUAL /usr)
  set(units /lib/systemd/system) # where Debian 12 has them
endif()
foreach(unit sofof-provide sofof-drive)
  configure_file(${source}/packaging/systemd/${unit}.service.in
    $ENV{DESTDIR}${units}/${unit}.service @ONLY)
  list(APPEND CMAKE_INSTALL_MANIFEST_FILES ${units}/${unit}.service)
endforeach()

# The notices of all that is linked, as its packages have them; without one of
# them nothing may be handed on.
set(notices ${root}/share/doc/sofof/copyright)
file(READ ${source}/packaging/deb/copyright text)
# notice_of(TITLE FILE): the file, under the title, is a part of `text`.
function(notice_of title file)
  if(NOT EXISTS ${file})
    message(FATAL_ERROR "The licence notice of ${title} is not at ${file}; "
      "install the package that has it, without leaving out its documents.")
  endif()
  file(READ ${file} notice)
  set(text "${text}\n\n==== ${title} ====\n\n${notice}" PARENT_SCOPE)
endfunction()
foreach(package libeigen3-dev nlohmann-json3-dev libcli11-dev libfmt-dev
    libtomlplusplus-dev libgeographiclib-dev libssl-dev libpcap0.8-dev
    zlib1g-dev libpugixml-dev ${proton})
  notice_of(${package} /usr/share/doc/${package}/copyright)
endforeach()
notice_of("C++ Actor Framework 0.18.7, with our patch" ${caf_licence})
file(WRITE ${notices} "${text}")
list(APPEND CMAKE_INSTALL_MANIFEST_FILES
  ${CMAKE_INSTALL_PREFIX}/share/doc/sofof/copyright)

if(CMAKE_INSTALL_PREFIX STREQUAL /usr) # a package
  set(changes ${root}/share/doc/sofof/changelog.Debian)
  string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
  file(WRITE ${changes} "sofof (${package_version}) bookworm; urgency=medium

  * What has changed is in changelog.gz.

 -- ${maintainer}  ${date}
")
  configure_file(${source}/CHANGELOG.md ${root}/share/doc/sofof/changelog COPYONLY)
  execute_process(COMMAND gzip -9nf ${changes} ${root}/share/doc/sofof/changelog
    COMMAND_ERROR_IS_FATAL ANY)
endif()
