// Workers of a sweep, as processes of their own on this machine.
#include "tests/processes/hosts.hpp"
#include "tests/processes/sweep_runs.hpp"
#include "tests/processes/workplace.hpp"
#include "tests/support/contains.hpp"

#include <array>
#include <map>
#include <optional>

using namespace sofof::test;
namespace fs = std::filesystem;

namespace {

/// Six short runs.
constexpr auto sweep_with_tracks = R"(name = "gaps"
scenario = "config/ulm_lehr.toml"
seeds = [1, 2]

[set]
duration = "60s"
fleet.0.count = 2

[[axis]]
name = "gap"
key = "service.trajectory_planning.max_interarrival"
values = ["60ms", "80ms", "100ms"]
)";

/// A worker that runs; what it keeps for itself lies in a folder of its own.
class worker_process {
public:
  /// Returns when it listens.
  explicit worker_process(const workplace& at, const words& more = {},
                          std::uint16_t port = 0, const conditions& how = {})
      : run_{words{"TMPDIR=" + folder(at).string(), how.program, "worker", "-j",
                   "1", "--listen", "127.0.0.1:" + std::to_string(port)}
                 + more,
             at.here(),
             {.program = "/usr/bin/env", .largest_file = how.largest_file}} {
    static constexpr std::string_view before = "listens on 127.0.0.1:";
    REQUIRE(wait_until([this] {
      return !run_.runs() || run_.printed().find('\n') != std::string::npos;
    }));
    const auto text = run_.printed();
    const auto found = text.find(before);
    if (found == text.npos)
      FAIL("no worker: ", run_.wait().err);
    port_ = static_cast<std::uint16_t>(
        std::stoi(text.substr(found + before.size())));
  }

  std::uint16_t port() const { return port_; }
  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }
  program& run() { return run_; }

private:
  static fs::path folder(const workplace& at) {
    fs::create_directories(at / "tmp");
    return at / "tmp";
  }

  std::uint16_t port_ = 0;
  program run_;
};

words sweep_by_workers(const std::string& out, const std::string& workers,
                       const std::string& jobs = "0") {
  return {"sweep", "gaps.toml", "--out", out, "-j", jobs, "--workers", workers};
}

/// @returns all files of all runs with what they hold; figures of the wall's
/// clock left out.
std::map<std::string, std::string> all_of(const fs::path& out) {
  std::map<std::string, std::string> all;
  for (const auto& entry : fs::recursive_directory_iterator{out}) {
    const auto name = entry.path().lexically_relative(out).string();
    if (!entry.is_regular_file() || name.ends_with("timing.csv"))
      continue;
    auto text = read_file(entry.path());
    if (name.ends_with("summary.json")) {
      auto summary = nlohmann::json::parse(text);
      summary.erase("wall_s");
      summary.erase("timing");
      text = summary.dump();
    }
    all[name] = text;
  }
  return all;
}

/// @returns what workers keep there now.
std::vector<fs::path> kept(const workplace& at) {
  std::vector<fs::path> found;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator{at / "tmp", none})
    found.push_back(entry.path());
  return found;
}

/// A workplace with the sweep in it.
struct sweep_place : workplace {
  sweep_place() { write("gaps.toml", sweep_with_tracks); }

  void sweep_here(const std::string& out) const {
    const auto end =
        run_sofof({"sweep", "gaps.toml", "--out", out, "-j", "2", "--quiet"});
    CAPTURE(end.err);
    REQUIRE(end.code == 0);
  }
};

} // namespace

TEST_CASE("a sweep by two workers equals that of one host, byte for byte") {
  const sweep_place at;
  at.sweep_here("here");
  worker_process one{at}, two{at};
  const auto end = at.run_sofof(
      sweep_by_workers("there", one.address() + "," + two.address()));
  CAPTURE(end.out);
  CAPTURE(end.err);
  CHECK(end.code == 0);
  CHECK(contains(end.out, "6 good, 0 unsafe, 0 failed"));
  CHECK(contains(end.out, "worker " + one.address() + " takes 1 runs"));
  const auto here = all_of(at / "here"), there = all_of(at / "there");
  CHECK(here.size() >= 6 * 8);
  CHECK(here.size() == there.size());
  for (const auto& [name, text] : here) {
    CAPTURE(name);
    REQUIRE(there.contains(name));
    CHECK((there.at(name) == text));
  }
  for (auto* worker : {&one, &two}) {
    const auto last = stop(worker->run());
    CHECK(last.code == 0);
    CHECK(last.err == "");
  }
}

TEST_CASE("own hands and a worker share the runs of a sweep") {
  const sweep_place at;
  worker_process worker{at};
  const auto end = at.run_sofof(sweep_by_workers("out", worker.address(), "1"));
  CHECK(end.code == 0);
  CHECK(contains(end.out, "6 good, 0 unsafe, 0 failed"));
}

TEST_CASE("a worker that is killed has its runs given to others, and one that "
          "comes back gets some again") {
  const sweep_place at;
  at.sweep_here("here");
  std::optional<worker_process> one{std::in_place, at};
  worker_process two{at};
  const auto port = one->port();
  const auto first = one->address();
  program sweep{sweep_by_workers("there", first + "," + two.address()),
                at.here()};
  REQUIRE(wait_until([&] { return summaries_in(at / "there") > 0; }));
  one->run().send(SIGKILL);
  one->run().wait();
  one.emplace(at, words{}, port);
  const auto end = sweep.wait();
  CAPTURE(end.out);
  CAPTURE(end.err);
  CHECK(end.code == 0);
  CHECK(contains(end.out, "6 good, 0 unsafe, 0 failed"));
  CHECK((read_file(at / "there/gaps.csv") == read_file(at / "here/gaps.csv")));
  CHECK(stop(one->run()).code == 0);
  CHECK(stop(two.run()).code == 0);
  CHECK(kept(at).size() == 1); // of the killed one
}

TEST_CASE("a worker that falls silent has its runs given to others") {
  const sweep_place at;
  worker_process one{at};
  program sweep{sweep_by_workers("out", one.address(), "1"), at.here()};
  REQUIRE(wait_until([&] { return summaries_in(at / "out") > 0; }));
  one.run().send(SIGSTOP);
  const auto end = sweep.wait();
  one.run().send(SIGCONT);
  CAPTURE(end.out);
  CAPTURE(end.err);
  CHECK(end.code == 0);
  CHECK(contains(end.out, "6 good, 0 unsafe, 0 failed"));
  const auto last = stop(one.run());
  CAPTURE(last.err);
  CHECK(last.code == 0);
}

TEST_CASE("a sweep whose workers are all lost ends with one sentence, and the "
          "same command goes on later") {
  const sweep_place at;
  std::optional<worker_process> worker{std::in_place, at};
  const auto port = worker->port();
  const auto command = sweep_by_workers("out", worker->address());
  program sweep{command, at.here()};
  REQUIRE(wait_until([&] { return summaries_in(at / "out") > 0; }));
  CHECK(stop(worker->run()).code == 0);
  const auto end = sweep.wait();
  CAPTURE(end.err);
  CHECK(end.code == 1);
  CHECK(end.err.starts_with("sofof: no site is left for "));
  CHECK(contains(end.err, "worker 127.0.0.1:" + std::to_string(port)));
  CHECK(std::ranges::count(end.err, '\n') == 1);
  CHECK_FALSE(fs::exists(at / "out/gaps.csv"));
  worker.emplace(at, words{}, port);
  const auto again = at.run_sofof(command);
  CHECK(again.code == 0);
  CHECK(contains(again.out, "6 good, 0 unsafe, 0 failed"));
}

TEST_CASE("a worker that is stopped leaves nothing behind") {
  const sweep_place at;
  for (const auto signal : {SIGINT, SIGTERM}) {
    worker_process worker{at};
    const auto out = "out" + std::to_string(signal); // new, so that runs/ tells
    program sweep{sweep_by_workers(out, worker.address()), at.here()};
    REQUIRE(wait_until([&] { return fs::exists(at / out / "runs"); }));
    pass(0.3);
    CHECK(kept(at).size() == 1);
    CHECK(stop(worker.run(), signal).code == 0);
    CHECK(kept(at).empty());
    CHECK(stop(sweep, SIGINT).code == 130);
  }
}

TEST_CASE("a run ends when its sweep goes away") {
  const sweep_place at;
  auto text = std::string{sweep_with_tracks};
  text.replace(text.find("60s"), 3, "87600h");
  at.write("gaps.toml", text);
  worker_process worker{at};
  program sweep{sweep_by_workers("out", worker.address()), at.here()};
  const auto runs = [&] {
    std::size_t count = 0;
    std::error_code none;
    for (const auto& folder : kept(at))
      for (const auto& run : fs::directory_iterator{folder, none})
        count += fs::exists(run.path() / "results/cycles.csv") ? 1U : 0U;
    return count;
  };
  REQUIRE(wait_until([&] { return runs() == 1; }));
  sweep.send(SIGKILL);
  sweep.wait();
  CHECK(wait_until([&] { return runs() == 0; }));
  CHECK(stop(worker.run()).code == 0);
}

TEST_CASE("what a worker cannot carry out is a point that failed") {
  const sweep_place at;
  auto text = std::string{sweep_with_tracks};
  text.replace(text.find("\"60ms\""), 6, "\"61ms\"");
  at.write("gaps.toml", text);
  worker_process worker{at, {}, 0, {.largest_file = 20'000}};
  const auto end = at.run_sofof(sweep_by_workers("out", worker.address()));
  CAPTURE(end.out);
  CHECK(end.code == 1);
  CHECK(contains(end.out, "0 good, 0 unsafe, 6 failed"));
  CHECK(contains(end.out, "failed: cannot write "));
  CHECK(stop(worker.run()).code == 0);
}

TEST_CASE("another build is refused with one sentence that names both") {
  const sweep_place at;
  fs::copy_file(SOFOF_PROGRAM, at / "other");
  std::ofstream{at / "other", std::ios::app} << '\n';
  const auto other = (at / "other").string();
  worker_process worker{at, {}, 0, {.program = other}};
  const auto end = at.run_sofof(sweep_by_workers("out", worker.address()));
  CAPTURE(end.err);
  CHECK(end.code == 2);
  CHECK(end.err.starts_with("sofof: worker " + worker.address()
                            + " refuses: the worker is sofof "));
  CHECK(contains(end.err, ", who asks is sofof "));
  CHECK(std::ranges::count(end.err, '\n') == 1);
  CHECK(contains(stop(worker.run()).out, "refused: the worker is sofof "));
}

TEST_CASE("another protocol, and who is no worker, are refused") {
  const sweep_place at;
  worker_process worker{at};
  auto end = at.run_sofof(sweep_by_workers("out", worker.address())
                          + words{"--test-protocol", "77"});
  CHECK(end.code == 2);
  CHECK(contains(end.err, "protocol 77 "));
  provider_process provider{at, "provider", {}};
  end = at.run_sofof(
      sweep_by_workers("out", "127.0.0.1:" + std::to_string(provider.port())));
  CAPTURE(end.err);
  CHECK(end.code == 2);
  CHECK(contains(end.err, "it is no worker"));
}

TEST_CASE("nobody to carry out runs, and plain words to other hosts, are "
          "wrong usage") {
  const sweep_place at;
  auto end = at.run_sofof({"sweep", "gaps.toml", "-j", "0"});
  CHECK(end.code == 2);
  CHECK(contains(end.err, "name hosts that do with --workers"));
  end = at.run_sofof(sweep_by_workers("out", "192.0.2.1:4712"));
  CHECK(end.code == 2);
  CHECK(contains(end.err, "must be secured"));
  end = at.run_sofof({"worker", "--listen", "0.0.0.0:0"});
  CHECK(end.code == 2);
  CHECK(contains(end.err, "must be secured"));
}

TEST_CASE("workers and sweeps with certificates work together, others do not") {
  const sweep_place at;
  for (const auto* ca : {"keys", "foreign"}) {
    REQUIRE(at.run_sofof({"keys", "init", ca}).code == 0);
    for (const auto& who :
         {words{"--provider", "worker"}, words{"--station", "1"}})
      REQUIRE(at.run_sofof(words{"keys", "issue", ca} + who).code == 0);
  }
  worker_process worker{at, {"--keys", "keys/provider-worker"}};
  const auto secured = [&](const std::string& folder) {
    return sweep_by_workers("out", worker.address()) + words{"--keys", folder};
  };
  auto end = at.run_sofof(secured("foreign/station-1"));
  CAPTURE(end.err);
  CHECK(end.code == 1);
  CHECK(contains(end.err, "no site is left for 6 runs: no connection to"));
  end = at.run_sofof(secured("keys/station-1"));
  CAPTURE(end.out);
  CHECK(end.code == 0);
  CHECK(contains(end.out, "6 good, 0 unsafe, 0 failed"));
  const auto last = stop(worker.run());
  CHECK(last.code == 0);
  CHECK(contains(last.out, "refused: "));
}
