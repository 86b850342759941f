// Where a process makes what others shall not see before it is finished.
#pragma once

#include "experiments/sweep/file_lock.hpp"

#include <filesystem>
#include <memory>

namespace sofof::experiments {

/// A folder of this process's own below one that many processes share, on
/// several machines; gone with this object. Where processes were killed, the
/// next one on the same machine removes theirs.
class work_folder {
public:
  /// @param shared  Exists.
  /// @throws std::filesystem::filesystem_error when none can be made.
  explicit work_folder(const std::filesystem::path& shared);
  work_folder(const work_folder&) = delete;
  work_folder& operator=(const work_folder&) = delete;
  ~work_folder();

  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
  std::unique_ptr<file_lock> lock_;
};

} // namespace sofof::experiments
