// Seed after seed, each in a process of its own, and what is kept of them.
#include "experiments/torture/torture.hpp"

#include "base/input_error.hpp"
#include "base/options/toml_file.hpp"
#include "experiments/torture/draw.hpp"
#include "experiments/torture/seed_log.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

using namespace sofof;
using namespace sofof::experiments::torture;

namespace {

const std::atomic<bool> never{false};

constexpr std::string_view plain = R"(duration = "30s"
[street_grid]
columns = 2
rows = 2
[[fleet]]
routes = ["block *"]
[[provider]]
area_radius_m = 500.0
[[service]]
name = "trajectory_planning"
[service.planner]
name = "lane_follow"
[policies]
lodm = "always"
codm = "always"
[record]
tracks = false
)";

verdict some_verdict() {
  verdict v;
  v.counts[counted::driven_s] = 12.5;
  v.counts[counted::loss] = 3;
  v.broken = {{"fresh_plan", "safety.without_fresh_plan_s is 0.2"}};
  return v;
}

} // namespace

TEST_CASE("a verdict goes through a pipe and stays the same") {
  const auto v = some_verdict();
  const auto back = parse_verdict(text_of(v));
  REQUIRE(back);
  CHECK(back->counts == v.counts);
  CHECK(back->broken == v.broken);
  CHECK_FALSE(parse_verdict(text_of(v).substr(0, 9)));
  CHECK_FALSE(parse_verdict(text_of(v) + "nonsense\n"));
}

TEST_CASE("a run that cannot go on breaks a promise, and ends nothing else") {
  const test::scratch at;
  const auto v = try_apart({"duration = 7\n"}, at / "one");
  REQUIRE(v.broken.size() == 1);
  CHECK(v.broken.front().promise == "it_ends");
  CHECK(test::contains(v.broken.front().what, "torture.toml:1:"));
  CHECK_FALSE(std::filesystem::exists(at / "one"));
}

TEST_CASE("hostile messages break no promise") {
  const test::scratch at;
  const auto v = try_here(
      {std::string{plain} + "[hostile]\nevery = \"10ms\"\n"}, at / "run");
  CHECK(v.is_good());
  CHECK(v.counts[counted::hostile] >= 2900);
  CHECK(v.counts[counted::offloaded_s] > 20);
}

TEST_CASE("a provider that lies is found out, and no promise breaks") {
  const test::scratch at;
  const auto v = try_here(
      {std::string{plain} + "[lies]\nwhat = \"jump\"\nafter = \"3s\"\n"},
      at / "run");
  CHECK(v.is_good());
  CHECK(v.counts[counted::lie] == 1); // it is not asked again for a minute
}

TEST_CASE("a provider that lies about tracks or scenes is found out, and no "
          "promise breaks") {
  const std::filesystem::path file =
      SOFOF_SOURCE_DIR "/config/chain/attacked.toml";
  const std::string lie = "what = \"tracks_removed\"";
  auto text = test::read_file(file);
  const auto put = [&text](std::string_view old, std::string_view other) {
    const auto at = text.find(old);
    REQUIRE(at != std::string::npos);
    text.replace(at, old.size(), other);
  };
  put("duration = \"60s\"", "duration = \"25s\"");
  SUBCASE("bodies are not told") {}
  SUBCASE("bodies are told beside their places") {
    put(lie, "what = \"tracks_shifted\"");
  }
  SUBCASE("nobody is told to lead") {
    put(lie, "what = \"scene_removed\"");
  }
  SUBCASE("crossings are told elsewhere") {
    put(lie, "what = \"scene_map\"");
  }
  const test::scratch at;
  const auto v = try_here({text, file}, at / "run");
  CHECK(v.is_good());
  CHECK(v.counts[counted::lie] >= 1);
}

TEST_CASE("a lie that nobody knows is refused") {
  CHECK_THROWS_WITH_AS(load({"[lies]\nwhat = \"jumps\"\n"}),
                       doctest::Contains("jump"), input_error);
}

TEST_CASE("seeds are tried once, by shards that share a folder") {
  const test::scratch at;
  torture_options how;
  how.out = at.path();
  how.program = "this one";
  how.jobs = 2;
  how.last = 4;
  std::ostringstream console;
  how.part = experiments::shard{1, 2};
  CHECK(try_seeds(how, never, console).tried == 2);
  CHECK(try_seeds(how, never, console).tried == 0);
  how.part = experiments::shard{2, 2};
  CHECK(try_seeds(how, never, console).tried == 2);
  CHECK(std::filesystem::exists(at / "seeds-2-of-2.csv"));
  how.part.reset();
  CHECK(try_seeds(how, never, console).tried == 0);
  const seed_log log{at.path(), "seeds.csv", "another"};
  REQUIRE(log.seeds().size() == 4);
  CHECK(log.seeds().at(1).program == "this one");
  CHECK(log.sum()[counted::driven_s] > 200);
  how.again = true;
  how.first = how.last = 2;
  CHECK(try_seeds(how, never, console).tried == 1);
}

TEST_CASE("it goes on until there are so many hours of vehicles") {
  const test::scratch at;
  torture_options how;
  how.out = at.path();
  how.last = 100;
  how.hours = 0.05;
  std::ostringstream console;
  const auto done = try_seeds(how, never, console);
  CHECK(done.tried >= 1);
  CHECK(done.tried < 10);
  CHECK(test::contains(console.str(), "vehicle hours"));
}

TEST_CASE("a log's last line counts, and one that was cut off does not") {
  const test::scratch at;
  {
    seed_log log{at.path(), "seeds.csv", "a program"};
    log.add(5, some_verdict());
    log.add(5, verdict{});
    log.add(6, some_verdict());
  }
  std::ofstream{at / "seeds.csv", std::ios::app} << "7,a pro";
  const seed_log log{at.path(), "seeds.csv", "another"};
  CHECK(log.seeds().size() == 2);
  CHECK(log.seeds().at(5).broken.empty());
  CHECK(log.seeds().at(6).broken == "fresh_plan");
  CHECK(log.sum()[counted::driven_s] == 12.5);
}
