// How deep TOML may nest, and what only looks deep.
#include "base/options/toml_depth.hpp"

#include "base/input_error.hpp"
#include "base/options/toml_file.hpp"
#include "base/options/toml_nodes.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <string>
#include <string_view>

using namespace sofof;

namespace {

std::string repeated(std::string_view part, std::size_t count) {
  std::string all;
  for (std::size_t i = 0; i < count; ++i)
    all += part;
  return all;
}

/// @returns what it says about a text; empty when it takes it.
std::string complaint(const std::string& text) {
  try {
    check_toml_depth(text, "x.toml");
    return {};
  } catch (const input_error& problem) {
    return problem.what();
  }
}

constexpr std::size_t most = most_toml_depth;
constexpr std::size_t far_too_deep = 200'000;

} // namespace

TEST_CASE("each way to nest ends at the same depth") {
  struct way {
    std::string_view begin, part, last, close, end;
    std::size_t own; ///< What the rest of the text takes of the depth.
  };
  for (const auto& w :
       {way{"[", "a.", "a", "", "]", 1}, way{"[[", "a.", "a", "", "]]", 2},
        way{"", "a.", "a", "", " = 1", 1},
        way{"", "\"a.\" . ", "'b'", "", " = 1", 1},
        way{"x = ", "[", "1", "]", "", 1}, way{"x = ", "{a=", "1", "}", "", 1},
        way{"x = ", "[ # [\n", "1", "]", "", 1},
        way{"\xef\xbb\xbf[", "a.", "a", "", "]", 1},
        way{"[t]\n", "a.", "a", "", " = 1", 2},
        way{"[t]\nx = [1, ", "{a=", "1", "}", "]", 3},
        way{"s = \"\"\"[\\\"\"\"\"\nx = ", "[", "1", "]", "", 1}}) {
    CAPTURE(w.begin);
    const auto text = [&](std::size_t n) {
      return std::string{w.begin} + repeated(w.part, n) + std::string{w.last}
             + repeated(w.close, n) + std::string{w.end} + "\n";
    };
    CHECK(complaint(text(most - w.own)) == "");
    CHECK(complaint(text(most - w.own + 1)) != "");
    CHECK(complaint(text(far_too_deep)) != "");
    CHECK_NOTHROW(parse_toml(text(most - w.own), "x.toml"));
  }
}

TEST_CASE("the place of what is too deep is told") {
  CHECK(complaint("a = 1\n[ü." + repeated("a.", far_too_deep) + "a]\n")
        == "x.toml:2:129: this is nested deeper than 64 tables and lists.");
  CHECK(complaint("a = " + repeated("[", far_too_deep))
        == "x.toml:1:68: this is nested deeper than 64 tables and lists.");
}

TEST_CASE("what is beside each other is not deep") {
  CHECK(
      complaint(repeated("[a.b]\nx.y = [1.5, {z.z = '...[[['}] # [.{\n", 1000))
      == "");
  CHECK(complaint("x = [" + repeated("{a.b.c = [[1]]}, ", 1000) + "]\n") == "");
  CHECK(complaint("x = \"" + repeated("[.", 1000) + "\"\n") == "");
  CHECK(complaint("x = '''\n" + repeated("[.'\n", 1000) + "'''\n") == "");
  CHECK(complaint("x = 1979-05-27T07:32:00.999\ny = 1.5e3\n") == "");
}

TEST_CASE("an option on the command line nests no deeper") {
  toml_file file{"", "x.toml"};
  CHECK_NOTHROW(file.set(repeated("a.", most - 1) + "a=1"));
  CHECK_THROWS_AS(file.set(repeated("a.", most) + "a=1"), input_error);
  CHECK_THROWS_AS(file.set("a=" + repeated("[", far_too_deep)), input_error);
}

TEST_CASE("texts of TOML's own characters do no harm") {
  constexpr std::string_view letters = "a.=[]{},\"'#\n\\ 1";
  test::dice dice{5};
  for (int n = 0; n < 20'000; ++n) {
    std::string text;
    const auto size = dice.between(1, 200);
    for (int i = 0; i < size; ++i)
      text += letters[static_cast<std::size_t>(
          dice.between(0, static_cast<double>(letters.size())))];
    try {
      parse_toml(text, "x.toml");
    } catch (const input_error& problem) {
      CHECK(std::string_view{problem.what()}.starts_with("x.toml:"));
    }
  }
}
