// Runs that appear whole in a folder that many share.
#include "experiments/sweep/run_store.hpp"

#include "base/input_error.hpp"
#include "base/options/toml_file.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <stdexcept>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

using namespace sofof;
using namespace sofof::experiments;
namespace fs = std::filesystem;

namespace {

constexpr auto whole = R"({"interrupted":false})";
constexpr auto cut_short = R"({"interrupted":true})";

void write_run(const fs::path& folder, std::string_view summary,
               std::string_view tracks = "") {
  fs::create_directories(folder);
  std::ofstream{folder / "tracks.csv"} << tracks;
  std::ofstream{folder / "summary.json"} << summary;
}

struct store_of_runs {
  test::scratch at;
  run_store store{at.path()};

  fs::path unfinished() const { return at / "runs/.unfinished"; }

  /// @returns whether nothing lies there but the locks of stores.
  bool leaves_nothing() const {
    for (const auto& entry : fs::recursive_directory_iterator{unfinished()})
      if (entry.path().parent_path() != unfinished()
          && entry.path().filename() != ".lock")
        return false;
    return true;
  }
};

} // namespace

TEST_CASE("a run appears when it is finished, with all that it wrote") {
  const store_of_runs in;
  in.store.add("abc", [&](const fs::path& there) {
    write_run(there, whole, "t");
    CHECK_FALSE(fs::exists(in.store.folder_of("abc")));
    CHECK_FALSE(in.store.summary_of("abc"));
  });
  CHECK(in.store.summary_of("abc") == whole);
  CHECK(read_text(in.store.folder_of("abc") / "tracks.csv") == "t");
  CHECK(in.leaves_nothing());
}

TEST_CASE("a run that was interrupted, is torn or failed leaves nothing") {
  const store_of_runs in;
  in.store.add("abc",
               [](const fs::path& there) { write_run(there, cut_short); });
  in.store.add("abc", [](const fs::path& there) { write_run(there, "{\"in"); });
  in.store.add("abc", [](const fs::path&) {});
  CHECK_THROWS_WITH(in.store.add("abc",
                                 [](const fs::path& there) {
                                   write_run(there, whole);
                                   throw std::runtime_error{"it must not be."};
                                 }),
                    "it must not be.");
  CHECK_FALSE(fs::exists(in.store.folder_of("abc")));
  CHECK(in.leaves_nothing());
}

TEST_CASE("of several that make the same run, the first one's stays") {
  const store_of_runs in;
  const run_store of_others{in.at.path()};
  in.store.add("abc", [&](const fs::path& there) {
    write_run(there, whole, "mine");
    of_others.add("abc", [](const fs::path& beside) {
      write_run(beside, whole, "theirs");
    });
  });
  CHECK(read_text(in.store.folder_of("abc") / "tracks.csv") == "theirs");
  CHECK(in.leaves_nothing());
}

TEST_CASE("what is no finished run is replaced by one") {
  const store_of_runs in;
  const auto old = in.store.folder_of("abc");
  for (const auto* summary : {"", cut_short}) {
    write_run(old, summary, "old");
    std::ofstream{old / "more.csv"} << "old";
    in.store.add("abc",
                 [](const fs::path& there) { write_run(there, whole, "new"); });
    CHECK(in.store.summary_of("abc") == whole);
    CHECK(read_text(old / "tracks.csv") == "new");
    CHECK_FALSE(fs::exists(old / "more.csv"));
    CHECK(in.leaves_nothing());
    fs::remove_all(old);
  }
}

TEST_CASE("many threads that make the same runs at once leave each once") {
  const store_of_runs in;
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([&in] {
      for (int run = 0; run < 10; ++run)
        in.store.add(std::to_string(run), [](const fs::path& there) {
          write_run(there, whole, "t");
        });
    });
  for (auto& thread : threads)
    thread.join();
  for (int run = 0; run < 10; ++run)
    CHECK(in.store.summary_of(std::to_string(run)) == whole);
  CHECK(in.leaves_nothing());
}

TEST_CASE("what a killed process left is removed; what may be in use stays") {
  const store_of_runs in;
  const auto child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const work_folder killed{in.unfinished()};
    write_run(killed.path() / "1/abc", "");
    _exit(0); // as a kill: nothing is tidied up
  }
  waitpid(child, nullptr, 0);
  CHECK_FALSE(in.leaves_nothing());
  const work_folder alive{in.unfinished()};
  const auto elsewhere = in.unfinished() / "0123456789abcdef-17-1";
  for (const auto& folder : {alive.path(), elsewhere})
    write_run(folder / "1/abc", "");
  std::ofstream{elsewhere / ".lock"};
  const run_store next{in.at.path()};
  CHECK(fs::exists(alive.path() / "1/abc"));
  CHECK(fs::exists(elsewhere / "1/abc"));
  fs::remove_all(alive.path() / "1");
  fs::remove_all(elsewhere);
  CHECK(in.leaves_nothing());
}

TEST_CASE("every process has a work folder of its own, gone with it") {
  const test::scratch at;
  fs::path first;
  {
    const work_folder one{at.path()}, another{at.path()};
    first = one.path();
    CHECK(one.path() != another.path());
    CHECK(fs::is_directory(one.path()));
  }
  CHECK_FALSE(fs::exists(first));
  CHECK(fs::is_empty(at.path()));
}

TEST_CASE("a folder that cannot be made is refused with a sentence") {
  const test::scratch at;
  std::ofstream{at / "file"};
  CHECK_THROWS_WITH_AS(run_store{at / "file"},
                       doctest::Contains("choose another folder with --out"),
                       input_error);
}
