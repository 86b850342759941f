// A file or socket that is open, and its owner.
#pragma once

#include <utility>

namespace sofof {

/// Owns a file descriptor.
class descriptor {
public:
  descriptor() = default;
  explicit descriptor(int fd) : fd_{fd} {}
  descriptor(descriptor&& other) noexcept
      : fd_{std::exchange(other.fd_, none)} {}
  descriptor& operator=(descriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~descriptor();

  int get() const { return fd_; }
  explicit operator bool() const { return fd_ != none; }

private:
  static constexpr int none = -1;
  int fd_ = none;
};

} // namespace sofof
