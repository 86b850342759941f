// Reading whole files that others may have put there.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace sofof {

/// A file's content, or why there is none.
struct file_content {
  std::string text;
  int error = 0;       ///< Of the system, e.g. ENOENT; 0: none.
  std::string refusal; ///< E.g. "it is a folder"; empty: it was read.
};

/// Reads a file if it is a regular one: devices, pipes and folders are refused
/// at once.
/// @param most  A longer file is refused, and no more of it is ever read;
/// bytes.
file_content read_regular_file(const std::filesystem::path& file,
                               std::size_t most);

} // namespace sofof
