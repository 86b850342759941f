// A chain of services: tracking, environment model, planning, in any split.
#include "base/input_error.hpp"
#include "scenario/load.hpp"
#include "tests/scenario/whole_run.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::test;
using namespace std::chrono_literals;

namespace {

const std::filesystem::path chain_config =
    std::filesystem::path{SOFOF_SOURCE_DIR} / "config";

constexpr std::string_view chain_head = R"(
name = "chain"
duration = "40s"
map = "maps/ulm_lehr.toml"
[traffic]
crossings = "perceived"
[[fleet]]
count = 6
routes = ["round_trip", "round_trip_opposite"]
[record]
tracks = true
)";

constexpr auto one_service = R"(
[[service]]
name = "trajectory_planning"
)";

constexpr auto three_services = R"(
[[service]]
name = "tracking"
[[service]]
name = "environment_model"
[[service]]
name = "trajectory_planning"
)";

constexpr auto in_no_time = R"(
[[service]]
name = "tracking"
compute = { run_time_mean = "0ms", run_time_sd = "0ms" }
[[service]]
name = "environment_model"
compute = { run_time_mean = "0ms", run_time_sd = "0ms" }
[[service]]
name = "trajectory_planning"
)";

memory_sink played(std::string_view rest) {
  return play(
      scenario::parse_scenario(std::string{chain_head} + std::string{rest},
                               chain_config / "chain.toml", {}));
}

/// One provider that offers the services whose bits are set.
std::string offering(unsigned which) {
  constexpr const char* names[] = {"tracking", "environment_model",
                                   "trajectory_planning"};
  std::string offered;
  for (unsigned k = 0; k < 3; ++k)
    if ((which >> k & 1U) != 0)
      offered += fmt::format("{}\"{}\"", offered.empty() ? "" : ", ", names[k]);
  return fmt::format("{}[policies]\nlodm = \"always\"\ncodm = \"always\"\n"
                     "[network]\nprofile = \"paper_sim\"\n[[provider]]\n"
                     "position_m = [0.0, 0.0]\narea_radius_m = 1000.0\n"
                     "services = [{}]\n",
                     three_services, offered);
}

} // namespace

TEST_CASE(
    "three services of one vehicle that take no time drive it as planning "
    "alone does") {
  const auto one = played(one_service);
  const auto three = played(in_no_time);
  REQUIRE(one.tracks.size() > 1000);
  REQUIRE(one.tracks.size() == three.tracks.size());
  for (std::size_t i = 0; i < one.tracks.size(); ++i) {
    CHECK(one.tracks[i].ego.own.position == three.tracks[i].ego.own.position);
    CHECK(one.tracks[i].ego.own.speed_mps == three.tracks[i].ego.own.speed_mps);
  }
}

TEST_CASE("in every split of the chain over one provider what is offered is "
          "offloaded, and the vehicles stay safe") {
  const service_name names[] = {"tracking", "environment_model",
                                "trajectory_planning"};
  for (unsigned which = 1; which < 8; ++which) {
    CAPTURE(which);
    const auto run = played(offering(which));
    CHECK(run.collisions.empty());
    for (const auto& x : run.safety)
      CHECK(x.without_fresh_plan == 0ms);
    for (unsigned k = 0; k < 3; ++k) {
      const auto used = std::ranges::count_if(run.cycles, [&](const auto& x) {
        return x.used && x.session.service == names[k];
      });
      CAPTURE(names[k].view());
      // Six vehicles, ten results a second at least, most of the time.
      CHECK((used > 1500) == ((which >> k & 1U) != 0));
    }
  }
}

TEST_CASE("each vehicle predicts the responses of a split by no fewer than 20 "
          "results, and all six do") {
  const service_name remote{"environment_model"};
  const auto run = played(offering(2));
  std::map<station_id, time_point> twentieth;
  std::map<station_id, int> results;
  for (const auto& x : run.cycles)
    if (x.session.service == remote && ++results[x.session.station] == 20)
      twentieth[x.session.station] = x.received;
  std::set<station_id> predicting;
  for (const auto& x : run.predictions)
    if (x.split.at(1)) {
      CHECK(x.at >= twentieth.at(x.station));
      predicting.insert(x.station);
    }
  CHECK(predicting.size() == 6);
}

TEST_CASE("a chain with a gap is refused, and one whose planner waits") {
  const auto refused = [](const std::string& services) {
    try {
      scenario::parse_scenario(std::string{chain_head} + services,
                               chain_config / "chain.toml", {});
    } catch (const input_error& why) {
      return std::string{why.what()};
    }
    return std::string{};
  };
  const std::string planning = one_service;
  CHECK(refused(planning + "[[service]]\nname = \"tracking\"\n")
            .find("has its results used by the service \"environment_model\"")
        != std::string::npos);
  CHECK(refused(planning + "[[service]]\nname = \"environment_model\"\n")
            .find("gets its inputs from the service \"tracking\"")
        != std::string::npos);
  CHECK(refused(three_services).empty());
  CHECK(refused(three_services + std::string{"per_input = true\n"})
            .find("nothing would be planned while \"environment_model\"")
        != std::string::npos);
  CHECK(refused(planning + "per_input = true\n").empty());
}
