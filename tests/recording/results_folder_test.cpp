// Whose folder a run writes into, and that nothing there is overwritten.
#include "recording/results_folder.hpp"

#include "recording/results.hpp"
#include "tests/recording/folder_checks.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/files.hpp"
#include "tests/support/made_up_run.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::made_up {

using namespace recording;

namespace fs = std::filesystem;
using test::contains;
using test::read_file;
using test::scratch;
using test::write_text;

TEST_CASE("runs without a folder of their own never share one") {
  const scratch dir;
  const auto make = [&dir](std::string_view name) {
    return make_results_folder({}, name, 7, false, {}, dir / "results");
  };
  CHECK(make("ulm") == dir / "results/ulm-7");
  CHECK(make("ulm") == dir / "results/ulm-7-2");
  CHECK(make("ulm") == dir / "results/ulm-7-3");
  CHECK(fs::is_directory(dir / "results/ulm-7-3"));
  CHECK(make("../etc/x y") == dir / "results/.._etc_x_y-7");
}

TEST_CASE("a folder's name tells what the run was told to change") {
  const scratch dir;
  const auto make = [&dir](const std::vector<std::string>& changes) {
    return make_results_folder({}, "ulm", 7, false, changes, dir.path());
  };
  CHECK(make({"policies.lodm=never"}) == dir / "ulm-7,lodm=never");
  CHECK(make({"policies.lodm=never"}) == dir / "ulm-7,lodm=never-2");
  CHECK(make({"duration=20s", "network.profile=../x"})
        == dir / "ulm-7,duration=20s,profile=.._x");
  CHECK(make({"name=" + std::string(500, 'x')}).filename().string().size()
        < 100);
}

TEST_CASE("a folder that is asked for is made with its parents") {
  const scratch dir;
  CHECK(make_results_folder(dir / "a/b", "ulm", 7, false) == dir / "a/b");
  CHECK(fs::is_directory(dir / "a/b"));
  // It is empty, so it may be used.
  CHECK(make_results_folder(dir / "a/b/", "ulm", 7, false) == dir / "a/b");
}

TEST_CASE("a folder with something in it is refused, and left alone") {
  const scratch dir;
  write_text(dir / "thesis.tex", "mine");
  const auto said =
      complaint([&dir] { make_results_folder(dir.path(), "ulm", 7, false); });
  CHECK(contains(said, "not empty"));
  CHECK(contains(said, "--force"));
  CHECK(names_in(dir.path()) == std::vector<std::string>{"thesis.tex"});
}

TEST_CASE("force replaces the files of a run and nothing else") {
  const scratch dir;
  write_text(dir / "thesis.tex", "mine");
  write_text(dir / "summary.json", "old");
  write_text(dir / "cycles.csv", "old");
  write_text(dir / "map_of_provider_12.toml", "old");
  write_text(dir / "map_of_provider_x.toml", "mine");
  CHECK(is_result(dir / "map_of_provider_3.toml", dir.path()));
  CHECK_FALSE(is_result(dir / "map_of_provider_.toml", dir.path()));
  auto info = run();
  info.cycles = false;
  results r{make_results_folder(dir.path(), "ulm", 7, true), info};
  CHECK(read_file(dir / "thesis.tex") == "mine");
  CHECK_FALSE(fs::exists(dir / "summary.json"));
  CHECK_FALSE(fs::exists(dir / "cycles.csv"));
  CHECK_FALSE(fs::exists(dir / "map_of_provider_12.toml"));
  CHECK(fs::exists(dir / "map_of_provider_x.toml"));
}

TEST_CASE("a file in the way of the folder is refused") {
  const scratch dir;
  write_text(dir / "out", "mine");
  for (const bool force : {false, true}) {
    const auto said =
        complaint([&] { make_results_folder(dir / "out", "ulm", 7, force); });
    CHECK(contains(said, "in the way"));
  }
  CHECK(read_file(dir / "out") == "mine");
}

TEST_CASE("a folder that cannot be made leaves no parents behind") {
  const scratch dir;
  const auto too_long = dir / "a" / std::string(300, 'x');
  const auto said =
      complaint([&] { make_results_folder(too_long, "ulm", 7, false); });
  CHECK(contains(said, "cannot make"));
  CHECK(contains(said, "--out"));
  CHECK_FALSE(fs::exists(dir / "a"));
}

} // namespace sofof::made_up
