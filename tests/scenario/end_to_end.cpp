// From an input to the arrival of its result: nothing of that is left out.
#include "scenario/load.hpp"
#include "tests/scenario/whole_run.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::test;
using namespace std::chrono_literals;

namespace {

const std::filesystem::path config =
    std::filesystem::path{SOFOF_SOURCE_DIR} / "config";

/// One car by the provider, whose camera sends 50 kB ten times a second: four
/// times what the cell carries.
memory_sink with_camera(const std::vector<std::string>& more = {}) {
  constexpr std::string_view text = R"(
name = "overloaded"
duration = "30s"
map = "maps/ulm_lehr.toml"

[[fleet]]
count = 1
first_station = 101
routes = ["west_to_east"]
placement = "convoy"
start_m = 50.0
start_speed_mps = 8.0

[[provider]]
name = "mec"
position_m = [0.0, 0.0]
area_radius_m = 1000.0

[network]
profile = "ideal"
cell_mbps = 1.0

[[service]]
name = "trajectory_planning"

[[service]]
name = "synthetic_load"

[policies]
lodm = "always"
codm = "always"
)";
  return play(scenario::parse_scenario(text, config / "overloaded.toml", more));
}

std::vector<cycle_record> results_of(const memory_sink& run,
                                     std::string_view service) {
  std::vector<cycle_record> all;
  std::ranges::copy_if(run.cycles, std::back_inserter(all),
                       [service](const cycle_record& x) {
                         return x.session.service == service;
                       });
  return all;
}

duration age(const cycle_record& x) {
  return x.received - x.timing.input_at;
}

} // namespace

TEST_CASE("an uplink that is asked for four times what it carries is noticed "
          "within a second, though every latency is short") {
  const auto run = with_camera();
  const auto results = results_of(run, "synthetic_load");
  REQUIRE_FALSE(results.empty());
  for (const auto& x : results) {
    CHECK(x.received - x.created < 20ms);
    CHECK(x.used == (age(x) <= 500ms));
  }
  CHECK(std::ranges::any_of(results, &cycle_record::used));
  CHECK_FALSE(std::ranges::all_of(results, &cycle_record::used));
  std::vector<episode_record> ended;
  std::ranges::copy_if(run.episodes, std::back_inserter(ended),
                       [](const episode_record& x) {
                         return x.of == side::requester && x.got_data
                                && x.session.service == "synthetic_load";
                       });
  REQUIRE_FALSE(ended.empty());
  CHECK(ended.front().reason == end_reason::qos_input_age);
  CHECK(ended.front().fallback);
  CHECK(ended.front().ended - ended.front().accepted <= 1s);
  CHECK(std::ranges::any_of(run.events, [](const event_record& x) {
    return x.what == event_type::violation
           && x.detail.starts_with("qos_input_age value_ms=");
  }));
  CHECK(std::ranges::any_of(run.events, [](const event_record& x) {
    return x.what == event_type::result_refused
           && x.detail.starts_with("input_age value_ms=");
  }));
}

TEST_CASE("of an uplink with room enough, every result is used, and tells what "
          "its input took") {
  const auto run = with_camera({"network.cell_mbps=100"});
  const auto results = results_of(run, "synthetic_load");
  REQUIRE(results.size() > 100);
  for (const auto& x : results) {
    CHECK(x.used);
    CHECK(x.timing.up.travel >= 4ms); // 50 kB at 100 Mbit/s
    CHECK(x.timing.up.travel < 5ms);
    CHECK(age(x) < 150ms);
  }
}

TEST_CASE("the parts of the time from an input to its result add up, and none "
          "is negative") {
  for (const auto* file : {"ulm_lehr", "busy_worker", "occluded_crossing"}) {
    CAPTURE(file);
    const std::vector<std::string> set{"duration=20s"};
    const auto run = play(
        scenario::load_scenario(config / (std::string{file} + ".toml"), set));
    REQUIRE_FALSE(run.cycles.empty());
    for (const auto& x : run.cycles) {
      const auto& t = x.timing;
      const auto since_created =
          t.queue + t.computing + t.down.wait + t.down.travel;
      CHECK(x.received - x.created == since_created);
      CHECK(age(x) == t.up.wait + t.up.travel + x.rest() + since_created);
      for (const auto part : {t.up.wait, t.up.travel, x.rest(), t.queue,
                              t.computing, t.down.wait, t.down.travel})
        CHECK(part >= 0ms);
    }
  }
}

TEST_CASE("with one result per input, latencies begin with the input, and no "
          "input has two") {
  const auto run = with_camera(
      {"network.cell_mbps=100", "service.synthetic_load.per_input=true"});
  const auto results = results_of(run, "synthetic_load");
  REQUIRE(results.size() > 100);
  auto last = time_point{};
  for (const auto& x : results) {
    CHECK(x.used);
    CHECK(x.created == x.timing.input_at);
    CHECK(x.received - x.created >= 4ms);
    CHECK(x.rest() == 0ms);
    CHECK(x.created > last);
    last = x.created;
  }
}
