// Runs for other hosts: what may be ordered, what comes back, and what is left
// behind.
#include "scenario/input_error.hpp"
#include "scenario/load.hpp"
#include "scenario/sweep/crew_run.hpp"
#include "scenario/sweep/order_files.hpp"
#include "scenario/sweep/result_files.hpp"
#include "scenario/sweep/run_site.hpp"
#include "scenario/toml_file.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <future>
#include <thread>

using namespace sofof;
namespace fs = std::filesystem;
using test::write_text;

namespace {

const std::string little = R"(name = "little"
duration = "1s"
[street_grid]
columns = 2
rows = 2
[[fleet]]
routes = ["block *"]
[[service]]
name = "trajectory_planning"
)";

/// A crew of one with a runner, and the folder of its orders.
struct workshop {
  test::scratch at;
  std::shared_ptr<crew> hands;

  explicit workshop(order_runner run)
      : hands{std::make_shared<crew>(1, std::move(run))} {}

  fs::path folder() const { return at / "order"; }
  std::unique_ptr<ordered_run> order() const {
    return make_crew_run(hands, folder());
  }
  static void carry_out(ordered_run& run) {
    std::promise<void> ended;
    run.begin([&] { ended.set_value(); });
    ended.get_future().wait();
  }
};

/// As an actor of the sweep's host does.
void fetch(ordered_run& run, result_files& to) {
  for (;;) {
    const auto piece = run.next();
    CHECK(piece.octets.size() <= longest_piece);
    if (piece.file.empty())
      break;
    REQUIRE_FALSE(to.take(piece));
  }
  CHECK_FALSE(to.finish());
}

} // namespace

TEST_CASE("a run that was carried out elsewhere leaves the same files") {
  workshop shop{[](const run_order& order) {
    own_site{"1"}.carry_out(load_scenario(order.given() / "config.toml"),
                            order.results(), order.interrupted);
  }};
  const auto s = parse_scenario(little, "little.toml");
  const auto run = shop.order();
  for (const auto& piece : order_of(s))
    CHECK_FALSE(run->add(piece));
  workshop::carry_out(*run);
  CHECK(run->report().ended);
  CHECK(run->report().failure == "");
  result_files back{shop.at / "back"};
  fetch(*run, back);
  const std::atomic<bool> never = false;
  own_site{"1"}.carry_out(s, shop.at / "here", never);
  int files = 0;
  for (const auto& here : fs::directory_iterator{shop.at / "here"}) {
    const auto name = here.path().filename();
    CAPTURE(name);
    REQUIRE(fs::exists(shop.at / "back" / name));
    if (name != "summary.json" && name != "timing.csv") // of the wall's clock
      CHECK((read_text(shop.at / "back" / name) == read_text(here.path())));
    ++files;
  }
  CHECK(files >= 8);
}

TEST_CASE("large files come in parts, and empty ones come too") {
  workshop shop{[](const run_order& order) {
    fs::create_directory(order.results());
    write_text(order.results() / "cycles.csv",
               std::string(3 * longest_piece, 'c'));
    write_text(order.results() / "tracks.csv",
               std::string(longest_piece + 1, 't'));
    write_text(order.results() / "episodes.csv", "");
    write_text(order.results() / "summary.json", "{}");
    write_text(order.results() / "other.txt", "no file of a run");
    fs::create_symlink("/etc/hostname", order.results() / "events.jsonl");
  }};
  const auto run = shop.order();
  workshop::carry_out(*run);
  result_files back{shop.at / "back"};
  fetch(*run, back);
  const auto at = shop.at / "back";
  CHECK(fs::file_size(at / "cycles.csv") == 3 * longest_piece);
  CHECK(fs::file_size(at / "tracks.csv") == longest_piece + 1);
  CHECK(fs::file_size(at / "episodes.csv") == 0);
  CHECK_FALSE(fs::exists(at / "other.txt"));
  CHECK_FALSE(fs::exists(at / "events.jsonl"));
}

TEST_CASE("an order has only files of an order, and not too much of them") {
  workshop shop{[](const run_order&) {}};
  const auto run = shop.order();
  for (const auto* name : {"../map.toml", "/tmp/map.toml", "", "summary.json",
                           "config.toml/x", ".", "map.toml\n"}) {
    CAPTURE(name);
    CHECK(run->add({name, "x"}));
  }
  CHECK_FALSE(run->add({"config.toml", "name = "}));
  CHECK_FALSE(run->add({"config.toml", "\"x\""}));
  CHECK(read_text(shop.folder() / "given/config.toml") == "name = \"x\"");
  const file_piece much{"trace.txt", std::string(std::size_t{1} << 20, ' ')};
  int taken = 0;
  while (!run->add(much))
    ++taken;
  CHECK(taken == 63);
}

TEST_CASE("results have only names that results have, each once") {
  const test::scratch at;
  result_files files{at / "run"};
  for (const auto* name :
       {"../summary.json", "/etc/passwd", "config.toml/../x", ".", "run"}) {
    CAPTURE(name);
    CHECK(files.take({name, "x"}));
  }
  CHECK_FALSE(files.take({"cycles.csv", "a"}));
  CHECK_FALSE(files.take({"cycles.csv", "b"}));
  CHECK_FALSE(files.take({"tracks.csv", "c"}));
  CHECK(files.take({"cycles.csv", "d"}));
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator{at.path()})
    count += entry.is_regular_file();
  CHECK(count == 2);
}

TEST_CASE("results without a summary are none, and it is written last") {
  const test::scratch at;
  result_files files{at / "run"};
  CHECK_FALSE(files.take({"config.toml", "x"}));
  CHECK(files.finish() == "it sends no summary");
  CHECK_FALSE(files.take({"summary.json", "{"}));
  CHECK_FALSE(files.take({"summary.json", "}"}));
  CHECK_FALSE(fs::exists(at / "run/summary.json"));
  CHECK_FALSE(files.take({"events.jsonl", ""}));
  CHECK_FALSE(files.finish());
  CHECK(read_text(at / "run/summary.json") == "{}");
  CHECK(read_text(at / "run/config.toml") == "x");
}

TEST_CASE("results replace those of an earlier run, and nothing else") {
  const test::scratch at;
  fs::create_directory(at / "run");
  write_text(at / "run/summary.json", "old");
  write_text(at / "run/notes.txt", "mine");
  result_files files{at / "run"};
  CHECK_FALSE(fs::exists(at / "run/summary.json"));
  CHECK(fs::exists(at / "run/notes.txt"));
}

TEST_CASE("a run that fails says why, and its folder goes with it") {
  workshop shop{[](const run_order&) { throw input_error{"no streets."}; }};
  auto run = shop.order();
  workshop::carry_out(*run);
  CHECK(run->report().ended);
  CHECK(run->report().failure == "no streets.");
  CHECK(fs::exists(shop.folder()));
  run.reset();
  shop.hands->stop();
  CHECK_FALSE(fs::exists(shop.folder()));
}

TEST_CASE("a run that nobody waits for is interrupted, and its folder goes") {
  std::promise<void> begun;
  workshop shop{[&](const run_order& order) {
    begun.set_value();
    while (!order.interrupted)
      std::this_thread::yield();
  }};
  auto run = shop.order();
  std::atomic<bool> told = false;
  run->begin([&] { told = true; });
  begun.get_future().wait();
  SUBCASE("as who ordered it has gone") {
    run.reset();
  }
  SUBCASE("as the worker ends") {
    shop.hands->stop();
    CHECK(!run->report().ended); // others do it
    run.reset();
  }
  shop.hands->stop();
  CHECK(!told);
  CHECK_FALSE(fs::exists(shop.folder()));
}
