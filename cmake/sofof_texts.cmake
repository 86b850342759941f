# Text files of a folder, in the program by their names.

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
