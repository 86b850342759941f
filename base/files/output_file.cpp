// Blocks of text on their way to the disk.
#include "base/files/output_file.hpp"

#include "base/input_error.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace sofof {

namespace {

[[noreturn]] void refused(const std::filesystem::path& path, int error,
                          std::string_view choose, std::string_view why = {}) {
  refuse_to_write(
      fmt::format(
          "cannot write {}: {}; choose {}{}", path.string(),
          why.empty() ? std::generic_category().message(error) : why, choose,
          error == ENOSPC || error == EDQUOT ? " or free some space" : ""),
      error);
}

/// Opens for writing, and does not wait for somebody to read a pipe.
std::FILE* open_file(const std::filesystem::path& path) {
  constexpr auto for_all = 0666;
  const auto file =
      open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NONBLOCK | O_CLOEXEC,
           for_all);
  if (file < 0)
    return nullptr;
  fcntl(file, F_SETFL, 0); // writing may wait
  return fdopen(file, "wb");
}

} // namespace

void refuse_to_write(const std::string& sentence, int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
    case EIO:
    case EROFS:
      throw storage_error{sentence};
    default:
      throw input_error{sentence};
  }
}

void output_file::check(const std::filesystem::path& path,
                        std::string_view choose) {
  std::error_code none;
  if (std::filesystem::is_directory(path, none))
    refused(path, EISDIR, choose);
  const auto there =
      std::filesystem::exists(path, none) ? path : path.parent_path() / ".";
  if (access(there.c_str(), W_OK) != 0)
    refused(path, errno, choose);
}

output_file::output_file(std::filesystem::path path, std::string_view choose)
    : path_{std::move(path)}, choose_{choose}, file_{open_file(path_)} {
  if (!file_ && errno == ENXIO)
    refused(path_, errno, choose_, "nobody reads from this pipe yet");
  if (!file_)
    refuse(errno);
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);
  text_.reserve(block_size + block_size / 8);
}

output_file::~output_file() {
  if (file_)
    std::fwrite(text_.data(), 1, text_.size(), file_.get());
}

void output_file::flush() {
  const auto done = std::fwrite(text_.data(), 1, text_.size(), file_.get());
  const auto complete = done == text_.size();
  text_.clear();
  if (!complete)
    refuse(errno);
}

void output_file::close() {
  flush();
  if (std::fclose(file_.release()) != 0)
    refuse(errno);
}

void output_file::refuse(int error) const {
  refused(path_, error, choose_);
}

void write_file(const std::filesystem::path& path, std::string_view text,
                std::string_view choose) {
  namespace fs = std::filesystem;
  std::error_code none;
  const auto target = fs::is_symlink(path, none) && fs::exists(path, none)
                          ? fs::canonical(path, none)
                          : path;
  if (fs::exists(target, none) && !fs::is_regular_file(target, none))
    refused(path, fs::is_directory(target, none) ? EISDIR : EINVAL, choose,
            fs::is_directory(target, none) ? "" : "it is no regular file");
  auto temporary = target;
  temporary += ".tmp";
  try {
    output_file out{temporary, choose};
    out.text() = text;
    out.close();
  } catch (...) {
    fs::remove(temporary, none);
    throw;
  }
  std::error_code error;
  fs::rename(temporary, target, error);
  if (error) {
    fs::remove(temporary, none);
    refused(path, error.value(), choose);
  }
}

} // namespace sofof
