// A lock that goes with its process, however that ends.
#pragma once

#include <filesystem>

namespace sofof::experiments {

/// A lock on a file of its own, held while this object lives. On a shared
/// folder it may hold on one machine only, or not at all: that depends on the
/// file system.
class file_lock {
public:
  /// Makes the file where it is missing; does not wait.
  explicit file_lock(const std::filesystem::path& file);
  file_lock(const file_lock&) = delete;
  file_lock& operator=(const file_lock&) = delete;
  ~file_lock();

  bool is_ours() const { return error_ == 0; }
  bool is_taken() const; ///< Another process has it.

private:
  int file_;
  int error_ = 0;
};

} // namespace sofof::experiments
