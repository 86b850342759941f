// Whole files, read and written at once.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

namespace sofof::test {

/// @returns all of a file; empty when there is none.
inline std::string read_file(const std::filesystem::path& file) {
  std::ifstream in{file, std::ios::binary};
  return {std::istreambuf_iterator<char>{in}, {}};
}

inline void write_text(const std::filesystem::path& file,
                       std::string_view text) {
  std::ofstream{file, std::ios::binary} << text;
}

} // namespace sofof::test
