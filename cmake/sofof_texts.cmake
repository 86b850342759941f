# Text files in the program.

# Builds the files FOLDER/*.EXTENSION into a library: FUNCTION(NAME) of NAMESPACE,
# which HEADER declares, returns the text of one; an empty one if there is none.
function(sofof_texts library folder extension header namespace function)
  file(GLOB files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.${extension})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${files})
  set(entries "")
  foreach(file ${files})
    cmake_path(GET file STEM name)
    file(READ ${file} text)
    string(APPEND entries "  {\"${name}\", R\"text(${text})text\"},\n")
  endforeach()
  set(generated ${PROJECT_BINARY_DIR}/generated/${function}.cpp)
  file(CONFIGURE OUTPUT ${generated} CONTENT
"// Generated from ${folder}.
#include \"@header@\"

#include <utility>

namespace @namespace@ {

namespace {

constexpr std::pair<std::string_view, std::string_view> @function@_texts[]{
@entries@  {}};

} // namespace

std::string_view @function@(std::string_view name) {
  for (const auto& [known, text] : @function@_texts)
    if (known == name)
      return text;
  return {};
}

} // namespace @namespace@
" @ONLY)
  target_sources(sofof_${library} PRIVATE ${generated})
endfunction()

# Builds one FILE into a library: the string_view NAME of NAMESPACE, which HEADER
# declares.
function(sofof_text library file header namespace name)
  set(path ${PROJECT_SOURCE_DIR}/${file})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
  file(READ ${path} text)
  set(generated ${PROJECT_BINARY_DIR}/generated/${name}.cpp)
  file(CONFIGURE OUTPUT ${generated} CONTENT
"// Generated from @file@.
#include \"@header@\"

namespace @namespace@ {

const std::string_view @name@ = R\"text(@text@)text\";

} // namespace @namespace@
" @ONLY)
  target_sources(sofof_${library} PRIVATE ${generated})
endfunction()
