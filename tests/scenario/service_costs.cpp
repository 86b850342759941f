// What a service asks of the radio is what its compute table says.
#include "scenario/build.hpp"
#include "scenario/energy_terms.hpp"
#include "scenario/load.hpp"
#include "scenario/runtime.hpp"
#include "tests/support/files.hpp"
#include "tests/support/memory_sink.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::scenario;
using namespace std::chrono_literals;

namespace {

const std::string whole_city = SOFOF_SOURCE_DIR "/config/ulm_lehr.toml";

/// What vehicles sent to providers, by service.
struct sent_inputs {
  std::map<std::string, channel::octet_count> counted_by_cells;
  std::map<std::string, std::uint64_t> told_by_vehicles, octets_told;
};

sent_inputs inputs_of(const scenario_definition& s) {
  const auto records = std::make_shared<test::memory_sink>();
  const auto time = make_virtual_runtime();
  const auto actors = build(time->system(), s, records, time->clock(), true);
  time->run_until(time->now() + s.length);
  dismiss(actors, *time);
  sent_inputs sent;
  for (const auto& provider : actors.loads)
    for (const auto& line : provider.octets_up->read(time->now())) {
      auto& sum = sent.counted_by_cells[line.what];
      sum += line.together().sent;
    }
  for (const auto& x : records->work)
    sent.told_by_vehicles[std::string{x.service.view()}] += x.inputs;
  for (const auto& x : records->work)
    sent.octets_told[std::string{x.service.view()}] += x.octets_up;
  return sent;
}

} // namespace

TEST_CASE("an input takes as many octets on the air as its service's compute "
          "table says, within 2 %, and all are told that are sent") {
  const auto s = parse_scenario(
      test::read_file(whole_city)
          + "\n[[service]]\nname = \"synthetic_load\"\n",
      whole_city,
      std::vector<std::string>{"duration=60s", "compute.workers=16"});
  const auto sent = inputs_of(s);
  REQUIRE(s.services.size() == 3);
  for (const auto& type : s.services) {
    const std::string name{type->name()};
    CAPTURE(name);
    REQUIRE(sent.counted_by_cells.contains(name));
    const auto& x = sent.counted_by_cells.at(name);
    CHECK(x.messages > 50);
    const auto mean =
        static_cast<double>(x.octets) / static_cast<double>(x.messages);
    const auto said = static_cast<double>(type->options.compute.input_octets);
    CHECK(mean == doctest::Approx(said).epsilon(0.02));
    const auto told = sent.told_by_vehicles.at(name);
    CHECK(told <= x.messages);
    CHECK(x.messages - told <= 2 + x.messages / 100); // ends of sessions
    CHECK(sent.octets_told.at(name) <= x.octets);
    CHECK(static_cast<double>(sent.octets_told.at(name))
          == doctest::Approx(mean * static_cast<double>(told)).epsilon(0.02));
  }
}

TEST_CASE("energy is reckoned from computers, servers and chains as the "
          "scenario has them") {
  const std::string light = SOFOF_SOURCE_DIR "/config/chain/light.toml";
  const auto s = load_scenario(
      light, std::vector<std::string>{"fleet.0.compute.computing_w=30",
                                      "fleet.0.compute.clock_ghz=1.5",
                                      "compute.worker_w=5"});
  const auto terms = energy_terms_of(s, {});
  REQUIRE(terms.chains.size() == 1);
  CHECK(terms.chains.front()
        == std::vector<std::string>{"tracking", "environment_model",
                                    "trajectory_planning"});
  REQUIRE(terms.vehicles.size() == 6);
  CHECK(terms.vehicles.at(101).computing_w == 30);
  const auto& planning = terms.costs.at({101, "trajectory_planning"});
  CHECK(planning.run_time == 11ms);
  CHECK(planning.period == 50ms);
  CHECK(planning.on_board_j == doctest::Approx(0.011 * 30));
  CHECK(terms.servers.at("mec").busy_w == 5);
  CHECK(terms.servers.at("mec").idle_w == doctest::Approx(0.74));
}

TEST_CASE("a service that is in no chain is one of its own") {
  const auto s = load_scenario(whole_city, std::vector<std::string>{});
  const auto terms = energy_terms_of(s, {});
  REQUIRE(terms.chains.size() == s.services.size());
  for (const auto& chain : terms.chains)
    CHECK(chain.size() == 1);
}
