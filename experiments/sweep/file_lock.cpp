// flock(2), which works for one's own processes on every file system.
#include "experiments/sweep/file_lock.hpp"

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace sofof::experiments {

file_lock::file_lock(const std::filesystem::path& file)
    : file_{::open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644)} {
  if (file_ < 0 || ::flock(file_, LOCK_EX | LOCK_NB) != 0)
    error_ = errno;
}

file_lock::~file_lock() {
  if (file_ >= 0)
    ::close(file_); // which unlocks it
}

bool file_lock::is_taken() const {
  return error_ == EWOULDBLOCK;
}

} // namespace sofof::experiments
