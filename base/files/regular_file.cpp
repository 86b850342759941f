// Open without waiting, look at what it is, then read.
#include "base/files/regular_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <fcntl.h>
#include <string_view>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace sofof {

namespace {

constexpr std::size_t kib = 1024, mib = 1024 * kib;

std::string_view name_of_kind(mode_t mode) {
  if (S_ISDIR(mode))
    return "a folder";
  if (S_ISFIFO(mode))
    return "a pipe";
  if (S_ISCHR(mode) || S_ISBLK(mode))
    return "a device";
  return "no regular file";
}

file_content too_long(std::size_t most) {
  return {{},
          EFBIG,
          most < mib ? fmt::format("it is longer than {} KiB", most / kib)
                     : fmt::format("it is longer than {} MiB", most / mib)};
}

} // namespace

regular_file::regular_file(const std::filesystem::path& file)
    // A pipe that nobody writes to would hold up a blocking open.
    : in_{::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)} {
  struct stat about {};
  if (!in_ || fstat(in_.get(), &about) != 0) {
    fail(errno);
    return;
  }
  size_ = static_cast<std::size_t>(about.st_size);
  if (!S_ISREG(about.st_mode)) {
    error_ = EINVAL;
    refusal_ = fmt::format("it is {}", name_of_kind(about.st_mode));
  }
}

std::size_t regular_file::read(std::string& to, std::size_t most) {
  assert(most > 0);
  if (error_ != 0)
    return 0;
  const auto before = to.size();
  to.resize(before + most);
  ssize_t more = 0;
  do
    more = ::read(in_.get(), to.data() + before, most);
  while (more < 0 && errno == EINTR);
  if (more < 0)
    fail(errno);
  const auto got = static_cast<std::size_t>(std::max<ssize_t>(more, 0));
  to.resize(before + got);
  return got;
}

void regular_file::fail(int error) {
  error_ = error;
  refusal_ = std::generic_category().message(error);
}

file_content read_regular_file(const std::filesystem::path& file,
                               std::size_t most) {
  regular_file in{file};
  if (in.error() == 0 && in.size() > most)
    return too_long(most);
  file_content content;
  content.text.reserve(in.size());
  // Files of /proc have no size, and others may still grow.
  const auto left = [&] {
    const auto done = content.text.size();
    return std::max(in.size() > done ? in.size() - done + 1 : 0, 64 * kib);
  };
  while (in.read(content.text, left()) > 0)
    if (content.text.size() > most)
      return too_long(most);
  if (in.error() != 0)
    return {{}, in.error(), in.refusal()};
  return content;
}

} // namespace sofof
