// A temporary file beside it, then its name.
#include "network/keys/atomic_file.hpp"

#include "base/files/descriptor.hpp"
#include "network/network_error.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace sofof::network {

namespace {

/// A file under a name of its own; gone with its owner.
class temporary_file {
public:
  explicit temporary_file(const std::filesystem::path& beside)
      : name_{beside.string() + ".XXXXXX"}, fd_{mkostemp(name_.data(),
                                                         O_CLOEXEC)} {}
  ~temporary_file() {
    if (fd_ < 0)
      return;
    close(fd_);
    unlink(name_.c_str());
  }
  temporary_file(const temporary_file&) = delete;
  temporary_file& operator=(const temporary_file&) = delete;

  bool is_open() const { return fd_ >= 0; }
  bool allow(mode_t mode) { return fchmod(fd_, mode) == 0; }
  bool write(std::string_view text) {
    while (!text.empty()) {
      const auto size = ::write(fd_, text.data(), text.size());
      if (size < 0)
        return false;
      text.remove_prefix(static_cast<std::size_t>(size));
    }
    return fsync(fd_) == 0;
  }
  /// Fails when there is a file of this name.
  bool link_to(const std::filesystem::path& path) const {
    return link(name_.c_str(), path.c_str()) == 0;
  }

  bool rename_to(const std::filesystem::path& path) const {
    return rename(name_.c_str(), path.c_str()) == 0;
  }

private:
  std::string name_;
  int fd_;
};

[[noreturn]] void refuse(const std::filesystem::path& path) {
  throw network_error{fmt::format("cannot write {}: {}; choose another folder",
                                  path.string(),
                                  std::generic_category().message(errno))};
}

} // namespace

void create_file(const std::filesystem::path& path, std::string_view text,
                 mode_t mode) {
  temporary_file file{path};
  if (!file.is_open() || !file.allow(mode) || !file.write(text)
      || !file.link_to(path))
    refuse(path);
}

void replace_file(const std::filesystem::path& path, std::string_view text,
                  mode_t mode) {
  temporary_file file{path};
  if (!file.is_open() || !file.allow(mode) || !file.write(text)
      || !file.rename_to(path))
    refuse(path);
}

void append_to_file(const std::filesystem::path& path, std::string_view line,
                    mode_t mode) {
  const descriptor file{
      open(path.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, mode)};
  // In one piece: others may add theirs at the same time.
  if (!file
      || write(file.get(), line.data(), line.size())
             != static_cast<ssize_t>(line.size()))
    refuse(path);
}

} // namespace sofof::network
