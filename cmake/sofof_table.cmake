# What is known by the name of its file, as a table: base/named.hpp.

# sofof_table(TARGET NAME FOLDER TYPE HEADER [EXCLUDE FILE])
# Each FOLDER/X.cpp defines `TYPE NAME_X()`, TYPE being declared in HEADER. TARGET
# finds them as `NAME_table`, sorted, in NAME_table.hpp and in the namespace of
# the FOLDER's room.
function(sofof_table target name folder type header)
  string(REGEX REPLACE "/.*" "" room ${folder})
  cmake_parse_arguments(PARSE_ARGV 5 arg "" "EXCLUDE" "")
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cpp)
  if(arg_EXCLUDE)
    list(REMOVE_ITEM sources ${PROJECT_SOURCE_DIR}/${folder}/${arg_EXCLUDE})
  endif()
  foreach(source ${sources})
    cmake_path(GET source STEM x)
    string(APPEND declarations "${type} ${name}_${x}();\n")
    string(APPEND entries "  {\"${x}\", ${name}_${x}},\n")
  endforeach()
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/${name}_table.hpp CONTENT
"// Generated from the files in @folder@.
#pragma once

#include \"base/named.hpp\"
#include \"@header@\"

namespace sofof::@room@ {

@declarations@
inline constexpr named<@type@> @name@_table[]{
@entries@};

} // namespace sofof::@room@
" @ONLY)
  target_include_directories(${target} PRIVATE ${PROJECT_BINARY_DIR}/generated)
endfunction()
