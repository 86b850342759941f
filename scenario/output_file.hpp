// A file that is written in large blocks, and says so when it cannot be.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace sofof {

/// Lines are appended to `text` and go to the disk block by block.
class output_file {
public:
  /// Creates the file, or empties it.
  /// @throws input_error when it cannot be opened.
  explicit output_file(std::filesystem::path path);

  output_file(const output_file&) = delete;
  output_file& operator=(const output_file&) = delete;

  /// Writes what is left, as far as possible.
  ~output_file();

  /// What is not on the disk yet.
  std::string& text() { return text_; }

  /// A line is complete. @throws input_error when the disk refuses it.
  void end_line() {
    if (text_.size() >= block_size)
      flush();
  }

  /// Hands everything to the operating system, which keeps it even when this
  /// process dies. @throws input_error when the disk refuses it.
  void flush();

  /// Flushes and closes. @throws input_error when the disk refuses it.
  void close();

private:
  static constexpr std::size_t block_size = 64 * 1024;

  struct closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, closer> file_;
  std::string text_;
};

/// Writes a whole file at once, under a temporary name first: whoever sees
/// it sees all of it.
/// @throws input_error when it cannot be written.
void write_file(const std::filesystem::path& path, std::string_view text);

} // namespace sofof
