// Options whose place in files has changed.
#include "base/input_error.hpp"
#include "base/options/option_printer.hpp"
#include "base/options/toml_file.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

using namespace sofof;

namespace {

/// What was `air.workers` is `house.workers`, and `barn` has become `house`.
struct moved_options {
  double workers = 1;
  double doors = 2;
  double wind = 3;
  bool was_air = false;

  void visit_options(option_visitor& s) {
    was_air = s.moved("air.workers", "house.workers");
    s.moved("barn", "house");
    s.table("air", [this](option_visitor& t) { t.field("wind", wind); });
    s.table("house", [this](option_visitor& t) {
      t.field("workers", workers, {0, 10});
      t.field("doors", doors);
    });
  }
};

struct outcome {
  moved_options read;
  std::vector<option_note> notes;
  std::string error;
};

outcome read_moved(std::string_view text,
                   const std::vector<std::string>& set = {}) {
  outcome all;
  toml_file file{text, "file.toml"};
  try {
    for (const auto& x : set)
      file.set(x);
    file.read([&](option_visitor& s) { all.read.visit_options(s); });
  } catch (const input_error& problem) {
    all.error = problem.what();
  }
  all.notes = file.notes();
  return all;
}

} // namespace

TEST_CASE("an option is read at its new place without a word") {
  const auto got = read_moved("[house]\nworkers = 4\n");
  CHECK(got.read.workers == 4);
  CHECK_FALSE(got.read.was_air);
  CHECK(got.notes.empty());
}

TEST_CASE("an option at its former place is read, with a note that has both") {
  const auto got = read_moved("[air]\nwind = 5\nworkers = 4\n");
  CHECK(got.error == "");
  CHECK(got.read.workers == 4);
  CHECK(got.read.wind == 5);
  CHECK(got.read.was_air);
  REQUIRE(got.notes.size() == 1);
  CHECK(got.notes[0].place == "file.toml:3:11");
  CHECK(got.notes[0].text.starts_with("air.workers is house.workers now"));
}

TEST_CASE("a table that has moved fills up one that is there") {
  const auto got = read_moved("barn = { doors = 7 }\n[house]\nworkers = 4\n");
  CHECK(got.error == "");
  CHECK(got.read.doors == 7);
  CHECK(got.read.workers == 4);
  REQUIRE(got.notes.size() == 1);
  CHECK(got.notes[0].text.starts_with("barn is house now"));
}

TEST_CASE("former place and new place together are refused, with both") {
  const auto got = read_moved("[house]\nworkers = 4\n[air]\nworkers = 4\n");
  CHECK(got.error.starts_with("file.toml:4:11: air.workers stands"));
  CHECK(got.error.find("house.workers") != std::string::npos);
  CHECK(got.error.find("file.toml:2:11") != std::string::npos);
  const auto of_table = read_moved("[house]\ndoors = 4\n[barn]\ndoors = 4\n");
  CHECK(of_table.error.starts_with("file.toml:4:9: doors stands"));
}

TEST_CASE("--set takes former places, and counts for more than the file") {
  const auto moved = read_moved("", {"air.workers=5"});
  CHECK(moved.read.workers == 5);
  REQUIRE(moved.notes.size() == 1);
  CHECK(moved.notes[0].place == "--set air.workers=5");
  CHECK(read_moved("[house]\nworkers = 4", {"air.workers=5"}).read.workers
        == 5);
  CHECK(read_moved("[air]\nworkers = 4", {"house.workers=5"}).read.workers
        == 5);
  const auto both = read_moved("", {"air.workers=5", "house.workers=6"});
  CHECK(both.error.starts_with("--set air.workers=5: air.workers stands"));
}

TEST_CASE("a wrong value at a former place is refused where it stands") {
  CHECK(read_moved("[air]\nworkers = 11\n").error
        == "file.toml:2:11: workers must be from 0 to 10, but is 11.");
  CHECK(read_moved("[barn]\ndors = 1\n").error.starts_with("file.toml:2:"));
  CHECK(read_moved("house = 3\n[air]\nworkers = 1\n").error
        != ""); // no table to move it to
}

TEST_CASE("a printer does not mind former places") {
  moved_options x;
  x.workers = 6;
  CHECK(print_options([&](option_visitor& s) { x.visit_options(s); })
        == "\n[air]\nwind = 3.0\n\n[house]\nworkers = 6.0\ndoors = 2.0\n");
}
