// A folder of a test's own, gone with it.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <unistd.h>

namespace sofof::test {

class scratch {
public:
  scratch() {
    static std::atomic<int> count = 0;
    at_ = std::filesystem::temp_directory_path()
          / ("sofof_scratch_" + std::to_string(getpid()) + "_"
             + std::to_string(count++));
    std::filesystem::create_directories(at_);
  }
  ~scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(at_, ignored);
  }
  scratch(const scratch&) = delete;
  scratch& operator=(const scratch&) = delete;

  std::filesystem::path operator/(const std::filesystem::path& name) const {
    return at_ / name;
  }
  const std::filesystem::path& path() const { return at_; }

private:
  std::filesystem::path at_;
};

} // namespace sofof::test
