// Tests of files that are written.
#include "base/files/output_file.hpp"

#include "base/input_error.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace sofof::test::output_files {

namespace fs = std::filesystem;

TEST_CASE("where a symbolic link stands, its file is written, and the link "
          "stays") {
  const scratch dir;
  write_file(dir / "target", "before");
  fs::create_symlink("target", dir / "link");
  write_file(dir / "link", "after");
  CHECK(fs::is_symlink(dir / "link"));
  CHECK(read_file(dir / "target") == "after");
}

TEST_CASE("what is no regular file is not replaced by one") {
  const scratch dir;
  REQUIRE(mkfifo((dir / "pipe").c_str(), 0600) == 0);
  CHECK_THROWS_WITH_AS(
      write_file(dir / "pipe", "text", "another file"),
      doctest::Contains("pipe: it is no regular file; choose another file"),
      input_error);
  CHECK(fs::is_fifo(dir / "pipe"));
  CHECK_THROWS_AS(write_file(dir.path(), "text"), input_error);
  CHECK(fs::is_directory(dir.path()));
}

TEST_CASE("a pipe that nobody reads is refused at once, one that is read is "
          "written") {
  const scratch dir;
  const auto pipe = dir / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  CHECK_THROWS_WITH_AS(output_file{pipe},
                       doctest::Contains("nobody reads from this pipe yet"),
                       input_error);
  const auto reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  REQUIRE(reader >= 0);
  output_file out{pipe};
  out.text() = "text";
  out.close();
  char text[9] = {};
  CHECK(read(reader, text, sizeof text) == 4);
  CHECK(std::string{text} == "text");
  close(reader);
}

} // namespace sofof::test::output_files
