// What may be read as a file, and what may not.
#include "base/files/regular_file.hpp"

#include "tests/support/files.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>

#include <cerrno>
#include <chrono>
#include <filesystem>
#include <sys/stat.h>

using namespace sofof;
using namespace sofof::test;

TEST_CASE("a regular file is read as a whole, up to its limit") {
  const scratch at;
  const auto file = at.path() / "file";
  for (const std::size_t size : {0, 1, 4095, 4096, 100'000}) {
    const std::string text(size, 'x');
    write_text(file, text);
    const auto read = read_regular_file(file, size);
    CHECK(read.refusal == "");
    CHECK((read.text == text));
    if (size > 0)
      CHECK(read_regular_file(file, size - 1).error == EFBIG);
  }
  constexpr std::size_t limit = 16 * 1024 * 1024;
  std::filesystem::resize_file(file, std::uintmax_t{10} << 30);
  CHECK(read_regular_file(file, limit).refusal == "it is longer than 16 MiB");
}

TEST_CASE("a file without a size of its own is read as well") {
  const auto read = read_regular_file("/proc/self/status", 1024 * 1024);
  CHECK(read.refusal == "");
  CHECK(read.text.find("VmRSS") != std::string::npos);
}

TEST_CASE("what is no regular file is refused at once") {
  const scratch at;
  const auto pipe = at.path() / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const auto begun = std::chrono::steady_clock::now();
  CHECK(read_regular_file(pipe, 10).refusal == "it is a pipe");
  CHECK(read_regular_file("/dev/zero", 10).refusal == "it is a device");
  CHECK(read_regular_file("/dev/tty", 10).refusal != "");
  CHECK(read_regular_file(at.path(), 10).refusal == "it is a folder");
  CHECK(read_regular_file(at.path() / "none", 10).error == ENOENT);
  CHECK(std::chrono::steady_clock::now() - begun < std::chrono::seconds{1});
}
