// Open without waiting, look at what it is, then read.
#include "base/files/regular_file.hpp"

#include "base/files/descriptor.hpp"

#include <fmt/format.h>

#include <algorithm>
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

file_content failed(int error) {
  return {{}, error, std::generic_category().message(error)};
}

file_content too_long(std::size_t most) {
  return {{},
          EFBIG,
          most < mib ? fmt::format("it is longer than {} KiB", most / kib)
                     : fmt::format("it is longer than {} MiB", most / mib)};
}

} // namespace

file_content read_regular_file(const std::filesystem::path& file,
                               std::size_t most) {
  // A pipe that nobody writes to would hold up a blocking open.
  const descriptor in{
      ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)};
  struct stat about {};
  if (!in || fstat(in.get(), &about) != 0)
    return failed(errno);
  if (!S_ISREG(about.st_mode))
    return {{}, EINVAL, fmt::format("it is {}", name_of_kind(about.st_mode))};
  const auto size = static_cast<std::size_t>(about.st_size);
  if (size > most)
    return too_long(most);
  file_content content;
  // Files of /proc have no size, and others may still grow.
  auto& text = content.text;
  std::size_t done = 0;
  for (text.resize(size + 1);; text.resize(std::max(2 * done, 64 * kib))) {
    while (done < text.size()) {
      const auto more =
          ::read(in.get(), text.data() + done, text.size() - done);
      if (more < 0 && errno == EINTR)
        continue;
      if (more < 0)
        return failed(errno);
      if (more == 0) {
        text.resize(done);
        return content;
      }
      done += static_cast<std::size_t>(more);
      if (done > most)
        return too_long(most);
    }
  }
}

} // namespace sofof
