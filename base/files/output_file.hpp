// A file that is written in large blocks, and says so when it cannot be.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace sofof {

/// Refuses to write something.
/// @param error  Of the system. Of a full or broken disk it makes a
///               storage_error.
/// @throws input_error.
[[noreturn]] void refuse_to_write(const std::string& sentence, int error);

/// Lines are appended to `text` and go to the disk block by block.
class output_file {
public:
  /// What its user can do about a file that cannot be written: choose ...
  static constexpr std::string_view other_folder = "another folder with --out";

  /// Refuses, without touching anything, what surely cannot be opened.
  /// @throws input_error.
  static void check(const std::filesystem::path& path, std::string_view choose);

  /// Creates the file, or empties it.
  /// @param choose  Ends the sentence that refuses it; outlives it.
  /// @throws input_error when it cannot be opened, or is a pipe that nobody
  /// reads.
  explicit output_file(std::filesystem::path path,
                       std::string_view choose = other_folder);

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

  [[noreturn]] void refuse(int error) const;

  std::filesystem::path path_;
  std::string_view choose_;
  std::unique_ptr<std::FILE, closer> file_;
  std::string text_;
};

/// Writes a whole file at once, under a temporary name first: whoever sees
/// it sees all of it. Where a symbolic link stands, its file is written.
/// @param choose  As for `output_file`.
/// @throws input_error when it cannot be written, or something else than a
/// regular file is there.
void write_file(const std::filesystem::path& path, std::string_view text,
                std::string_view choose = output_file::other_folder);

} // namespace sofof
