// A chain of services that comes home warm: how soon, and as what.
#include "scenario/load.hpp"
#include "tests/scenario/watched_chain.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <string>

using namespace sofof;
using namespace sofof::test;
using namespace std::chrono_literals;

namespace {

const std::filesystem::path light_scenario =
    std::filesystem::path{SOFOF_SOURCE_DIR} / "config/chain/light.toml";

/// The whole chain is offloaded; now and then nothing gets through.
scenario::scenario_definition falling_silent(bool is_warm) {
  std::vector<std::string> changes{
      "duration=60s", "policies.lodm=always", "policies.codm=always",
      "provider.mec.area_radius_m=3000.0",
      "network.outage=[{from=\"20s\",to=\"22s\"},{from=\"40s\",to=\"42s\"}]"};
  if (is_warm)
    for (const auto* name :
         {"tracking", "environment_model", "trajectory_planning"})
      changes.push_back(fmt::format("service.{}.warm_standby=2s", name));
  return scenario::load_scenario(light_scenario, changes);
}

} // namespace

TEST_CASE("when the server of a warm chain falls silent, the chain at home "
          "has a plan of its own within one period, as one that never left "
          "would have it") {
  const auto run = watch(falling_silent(true));
  const auto changes = changes_home(*run);
  CHECK(run->records.collisions.empty());
  for (const auto& x : run->records.safety)
    CHECK(x.without_fresh_plan == 0ms);
  std::size_t counted = 0;
  for (const auto& x : changes) {
    CAPTURE(x.station);
    CAPTURE(to_seconds(x.at.time_since_epoch()));
    CAPTURE(x.reason);
    if (x.reason == "shutdown")
      continue; // the run is over
    REQUIRE(x.first);
    CHECK(*x.first <= 50ms);
    CHECK(x.plan.tracks_apart_m < 0.01);
    CHECK(x.plan.scene_apart_m < 0.01);
    CHECK(x.plan.plan_apart_m < 0.1);
    ++counted;
  }
  CHECK(counted >= 12); // six vehicles, twice
}
