// Blocks of text on their way to the disk.
#include "scenario/output_file.hpp"

#include "scenario/input_error.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace sofof {

namespace {

[[noreturn]] void refused(const std::filesystem::path& path, int error) {
  throw input_error(fmt::format(
      "cannot write {}: {}; choose another folder with --out{}", path.string(),
      std::generic_category().message(error),
      error == ENOSPC || error == EDQUOT ? " or free some space" : ""));
}

} // namespace

output_file::output_file(std::filesystem::path path)
    : path_{std::move(path)}, file_{std::fopen(path_.c_str(), "wb")} {
  if (!file_)
    refused(path_, errno);
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
    refused(path_, errno);
}

void output_file::close() {
  flush();
  if (std::fclose(file_.release()) != 0)
    refused(path_, errno);
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  auto temporary = path;
  temporary += ".tmp";
  try {
    output_file out{temporary};
    out.text() = text;
    out.close();
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw;
  }
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (error)
    refused(path, error.value());
}

} // namespace sofof
