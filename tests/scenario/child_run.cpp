// Orders in processes of their own: programs that do well, and others.
#include "scenario/sweep/child_run.hpp"

#include "scenario/toml_file.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <thread>

using namespace sofof;
namespace fs = std::filesystem;

namespace {

constexpr child_limits plenty{std::uint64_t{1} << 30, std::uint64_t{1} << 20};

/// An order, and a program that carries it out.
struct errand {
  test::scratch at;
  run_order order{at / "order"};

  /// @param does  Lines for a shell; $out is the results folder.
  void run(const std::string& does, const child_limits& limits = plenty) const {
    const auto file = at / "program";
    std::ofstream{file} << "#!/bin/sh\n"
                           "out=$4\n"
                           "[ \"$1 $3\" = 'run --out' ] || exit 9\n"
                           "[ \"${2##*/}\" = config.toml ] || exit 9\n"
                           "mkdir \"$out\"\n"
                        << does << '\n';
    fs::permissions(file, fs::perms::owner_all);
    run_as_child(file, order, limits);
  }
};

const std::string succeeds = "echo '{}' >$out/summary.json";

} // namespace

TEST_CASE("a run that succeeds leaves its results") {
  const errand one;
  one.run(succeeds);
  CHECK(read_text(one.order.results() / "summary.json") == "{}\n");
}

TEST_CASE("a run whose safety checks failed has results as well") {
  const errand one;
  one.run(succeeds + "\nexit 1");
}

TEST_CASE("a run that fails says why") {
  const errand one;
  CHECK_THROWS_WITH(one.run("echo 'sofof: there are no streets.' >&2; exit 2"),
                    "there are no streets.");
}

TEST_CASE("a run that crashes says which signal it was") {
  const errand one;
  CHECK_THROWS_WITH(one.run("kill -ABRT $$"),
                    "its process was ended by signal 6 "
                    "(Aborted)");
}

TEST_CASE("a run that cannot be started is a failure") {
  const errand one;
  CHECK_THROWS_WITH(run_as_child(one.at / "nothing", one.order, plenty),
                    "its process ended without a result");
}

TEST_CASE("a run that takes too much memory is ended") {
  const errand one;
  auto little = plenty;
  little.memory = std::uint64_t{64} << 20;
  CHECK_THROWS_WITH_AS(
      one.run("x=$(head -c 134217728 /dev/zero | tr '\\0' x)\nsleep 100",
              little),
      doctest::Contains("it needs more than 64 MiB"), std::runtime_error);
}

TEST_CASE("a run cannot write files of any length") {
  const errand one;
  CHECK_THROWS_WITH_AS(
      one.run("head -c 3000000 /dev/zero 2>&1 >$out/cycles.csv || {\n"
              "  echo 'sofof: the file is too large.' >&2; exit 2; }"),
      "the file is too large.", std::runtime_error);
  CHECK(fs::file_size(one.order.results() / "cycles.csv")
        == plenty.largest_file);
}

TEST_CASE("a run that is interrupted ends at once, whatever it does") {
  errand one;
  std::thread other{[&] {
    while (!fs::exists(one.order.results() / "begun"))
      std::this_thread::yield();
    one.order.interrupted = true;
  }};
  CHECK_THROWS_WITH(one.run("trap '' TERM INT\necho >$out/begun\nsleep 100"),
                    "it was interrupted");
  other.join();
}
