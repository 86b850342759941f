// Drives chains of services that come home, for tests/acceptance/chain/warm.
//
//   warm_changes SPLIT TRIGGER WARM SEED SECONDS
//
// In virtual time. SPLIT: what the provider offers, of t, e and p (tracking,
// environment model, planning); TRIGGER: silence, crash, area, rss or link;
// WARM: the services' warm_standby, "0s" for none. Prints a line for each time
// that the last service of a vehicle's chain comes home, "change NAME=VALUE
// ...", and at last one line "run NAME=VALUE ...".
#include "scenario/init_messages.hpp"
#include "scenario/load.hpp"
#include "tests/scenario/watched_chain.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::test;
using namespace std::chrono_literals;

namespace {

constexpr std::string_view chain[]{"tracking", "environment_model",
                                   "trajectory_planning"};

/// @returns changes of config/chain/light.toml.
std::vector<std::string> changes_of(std::string_view split,
                                    std::string_view trigger,
                                    std::string_view warm,
                                    std::string_view seed, int seconds) {
  std::string offered, outages;
  for (const auto name : chain)
    if (split.find(name == "trajectory_planning" ? 'p' : name.front())
        != std::string_view::npos)
      offered += fmt::format("{}\"{}\"", offered.empty() ? "" : ", ", name);
  std::vector<std::string> all{
      fmt::format("duration={}s", seconds),
      fmt::format("seed={}", seed),
      "policies.codm=always",
      "record.tracks_period=50ms",
      "fleet.0.count=10",
      fmt::format("provider.mec.services=[{}]", offered)};
  for (const auto name : chain)
    all.push_back(fmt::format("service.{}.warm_standby={}", name, warm));
  if (trigger == "area") {
    all.emplace_back("provider.mec.area_radius_m=120.0");
    all.emplace_back("policies.lodm={name=\"location\",radius_m=120.0}");
    return all;
  }
  all.emplace_back("provider.mec.area_radius_m=1000.0");
  all.emplace_back(trigger == "rss"
                       ? "policies.lodm={name=\"always\",govern=[\"rss\"]}"
                       : "policies.lodm=always");
  if (trigger == "silence") {
    for (int t = 15; t < seconds; t += 10)
      outages += fmt::format("{}{{from=\"{}s\",to=\"{}s\"}}",
                             outages.empty() ? "" : ",", t, t + 2);
    all.push_back(fmt::format("network.outage=[{}]", outages));
  }
  if (trigger == "crash") {
    all.push_back(fmt::format("provider.mec.fails_at={}s", seconds / 2));
    all.push_back(fmt::format("provider.mec.returns_at={}s", seconds / 2 + 1));
  }
  if (trigger == "link")
    all.emplace_back("network.profile=spiky_5g");
  return all;
}

/// How a vehicle drives in the two seconds after a change.
struct ride_after {
  int hard_brakes = 0;   ///< That begin.
  double off_plan_m = 0; ///< The farthest from where its plan in use has it.
  double jump_m = 0;     ///< From the plan before to the first own one.
};

ride_after ride_of(const watched_run& run, const change_home& change) {
  ride_after of;
  bool brakes = true; // one that goes on already is none of this change's
  for (const auto& x : run.records.tracks) {
    if (x.ego.own.station != change.station || x.at < change.at
        || x.at > change.at + 2s)
      continue;
    const auto hard = x.ego.own.accel_mps2 < world::ride_comfort::hard_mps2;
    of.hard_brakes += hard && !brakes;
    brakes = hard;
    if (x.plan && !x.plan->empty())
      of.off_plan_m = std::max(
          of.off_plan_m, distance_m(x.plan->at(x.at).at, x.ego.own.position));
  }
  for (const auto& x : run.records.plan_switches)
    if (x.session.station == change.station && !x.remote && x.at >= change.at
        && x.at <= change.at + 2s)
      of.jump_m = std::max(of.jump_m, std::abs(x.jump.d_m));
  return of;
}

std::string ms_of(const std::optional<duration>& x) {
  return x ? fmt::format("{:.3f}", 1e3 * to_seconds(*x)) : "none";
}

void print(const watched_run& run) {
  for (const auto& x : changes_home(run)) {
    const auto ride = ride_of(run, x);
    std::cout << fmt::format(
        "change station={} t={:.3f} reason={} first_ms={} left_ms={} "
        "tracks_m={:.4f} scene_m={:.4f} plan_m={:.4f} hard={} "
        "off_plan_m={:.4f} "
        "jump_m={:.4f}\n",
        x.station, to_seconds(x.at.time_since_epoch()), x.reason,
        ms_of(x.first), ms_of(x.left), x.plan.tracks_apart_m,
        x.plan.scene_apart_m, x.plan.plan_apart_m, ride.hard_brakes,
        ride.off_plan_m, ride.jump_m);
  }
  double without_plan_s = 0;
  std::uint64_t along = 0, on_board = 0;
  for (const auto& x : run.records.safety)
    without_plan_s += to_seconds(x.without_fresh_plan);
  for (const auto& x : run.records.work) {
    along += x.along;
    on_board += x.on_board;
  }
  std::cout << fmt::format(
      "run collisions={} without_plan_s={:.3f} along={} on_board={}\n",
      run.records.collisions.size(), without_plan_s, along, on_board);
}

} // namespace

int main(int argc, char** argv) {
  const std::vector<std::string_view> said{argv + 1, argv + argc};
  if (said.size() != 5) {
    std::cerr << "usage: warm_changes SPLIT TRIGGER WARM SEED SECONDS\n";
    return 2;
  }
  scenario::init_messages();
  try {
    print(*watch(scenario::load_scenario(
        SOFOF_SOURCE_DIR "/config/chain/light.toml",
        changes_of(said[0], said[1], said[2], said[3], std::atoi(argv[5])))));
  } catch (const std::exception& why) {
    std::cerr << why.what() << '\n';
    return 2;
  }
  return 0;
}
