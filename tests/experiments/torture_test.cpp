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
#include <fmt/format.h>

#include <atomic>
#include <cstdlib>
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

/// The same town, and the other services of a chain.
std::string chained() {
  return std::string{plain}
         + "[[service]]\nname = \"tracking\"\n"
           "[[service]]\nname = \"environment_model\"\n";
}

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

TEST_CASE("a provider that lies about plans that a chain makes is found out") {
  const test::scratch at;
  const auto v = try_here({chained() + R"([lies]
what = "jump"
after = "3s"
)"},
                          at / "run");
  CHECK(v.is_good());
  CHECK(v.counts[counted::lie] == 1);
}

TEST_CASE("how long each part of a chain was offloaded is counted") {
  const test::scratch at;
  const auto all = try_here({chained()}, at / "all");
  CHECK(all.is_good());
  CHECK(all.counts[counted::chain_s] == all.counts[counted::driven_s]);
  CHECK(all.counts[counted::tracking_s] > 20);
  CHECK(all.counts[counted::environment_s] > 20);
  const auto alone = try_here({std::string{plain}}, at / "alone");
  CHECK(alone.counts[counted::chain_s] == 0);
  CHECK(alone.counts[counted::tracking_s] == 0);
}

TEST_CASE("a service of a chain that gives nothing for seconds is found") {
  const test::scratch at;
  const auto loaded = load({chained()});
  run(loaded, at / "run");
  const auto breaks = [&] {
    broken_promises all;
    check_chain(read_finished(loaded.what, at / "run"), all);
    return all;
  };
  CHECK(breaks().empty());
  const auto silence = [&](std::string_view service, auto&& is_silent_at) {
    const auto file = at / "run" / "protocol_trace.csv";
    std::ifstream in{file};
    std::string kept;
    for (std::string line; std::getline(in, line);)
      if (!test::contains(line, "selector")
          || !test::contains(line, fmt::format("{}#", service))
          || !is_silent_at(std::atof(line.c_str())))
        kept += line + '\n';
    in.close();
    std::ofstream{file} << kept;
  };
  silence("tracking", [](double t_s) { return t_s > 10 && t_s < 12; });
  auto found = breaks();
  REQUIRE(found.size() == 1);
  CHECK(found.front().promise == "chain_goes_on");
  CHECK(test::contains(found.front().what, "tracking of station 101"));
  silence("environment_model", [](double t_s) { return t_s > 20; });
  CHECK(breaks().size() == 2); // one is silent to the end
}

TEST_CASE("only seeds are tried whose scenario has the words that are asked "
          "for") {
  const test::scratch at;
  torture_options how;
  how.out = at.path();
  how.last = 4;
  how.with = "tracking";
  std::ostringstream console;
  std::size_t wanted = 0;
  for (std::uint64_t seed = how.first; seed <= how.last; ++seed)
    wanted += test::contains(draw(seed), how.with);
  CHECK(try_seeds(how, never, console).tried == wanted);
  how.with = "no such words";
  CHECK(try_seeds(how, never, console).tried == 0);
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
