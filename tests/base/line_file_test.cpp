// Long files, line by line.
#include "base/files/line_file.hpp"

#include "base/input_error.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::test;

TEST_CASE("a file is read line by line, however long it and its lines are") {
  const scratch at;
  std::vector<std::string> lines;
  for (std::size_t length : {0, 1, 300'000, 17, 262'143, 262'144, 5})
    lines.emplace_back(length, 'x');
  std::string text;
  for (const auto& line : lines)
    text += line + '\n';
  for (const auto* rest : {"", "no end"}) {
    write_text(at.path() / "file", text + rest);
    line_file file{at.path() / "file"};
    for (const auto& line : lines) {
      CHECK((file.next() == line));
      CHECK(file.has_end());
    }
    CHECK(file.number() == lines.size());
    if (*rest) {
      CHECK(file.next() == rest);
      CHECK_FALSE(file.has_end());
    }
    CHECK_FALSE(file.next());
  }
}

TEST_CASE("a line of more than a mebibyte is refused, wherever it ends") {
  const scratch at;
  const auto longest = line_file::longest_line;
  for (const auto* end : {"\n", ""}) {
    write_text(at.path() / "file",
               "first\n" + std::string(2 * longest, 'x') + end);
    line_file file{at.path() / "file"};
    file.next();
    CHECK_THROWS_WITH_AS(file.next(),
                         ((at.path() / "file").string()
                          + ":2: this line is longer than 1024 KiB.")
                             .c_str(),
                         input_error);
  }
}

TEST_CASE("what is no file of lines is refused") {
  const scratch at;
  CHECK_THROWS_AS(line_file{at.path()}, input_error);
  CHECK_THROWS_AS(line_file{at.path() / "missing"}, input_error);
}
