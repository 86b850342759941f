// Reading files that others may have put there.
#pragma once

#include "base/files/descriptor.hpp"

#include <cstddef>
#include <filesystem>
#include <string>

namespace sofof {

/// A file that is open if it is a regular one: devices, pipes and folders are
/// refused at once.
class regular_file {
public:
  explicit regular_file(const std::filesystem::path& file);

  /// @returns how long it was when it was opened, bytes.
  std::size_t size() const { return size_; }

  /// Reads on, behind what `to` has already.
  /// @param most  At most so many bytes; > 0.
  /// @returns how many there were: 0 at its end, and where it cannot be read.
  std::size_t read(std::string& to, std::size_t most);

  int error() const { return error_; } ///< Of the system; 0: none.
  /// @returns why it is not or no longer read, e.g. "it is a folder".
  const std::string& refusal() const { return refusal_; }

private:
  void fail(int error);

  descriptor in_;
  std::size_t size_ = 0;
  int error_ = 0;
  std::string refusal_;
};

/// A file's content, or why there is none.
struct file_content {
  std::string text;
  int error = 0;       ///< Of the system, e.g. ENOENT; 0: none.
  std::string refusal; ///< E.g. "it is a folder"; empty: it was read.
};

/// Reads all of a regular file.
/// @param most  A longer file is refused, and no more of it is ever read;
/// bytes.
file_content read_regular_file(const std::filesystem::path& file,
                               std::size_t most);

} // namespace sofof
