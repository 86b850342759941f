// What a scenario says of its road: vehicles and rules.
#pragma once

#include "base/ids.hpp"
#include "base/options/option_helpers.hpp"
#include "scenario/ride_options.hpp"
#include "world/vehicle/cycle_cost.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::scenario {

/// Vehicles with consecutive station ids that share their routes.
struct fleet_options {
  std::int64_t count = 1;
  std::int64_t first_station = 101;
  /// Names of routes; station number i takes the i-th, round and round. One
  /// with `*` at its end stands for all that begin so.
  std::vector<std::string> routes{"round_trip"};
  /// "equal": spread evenly over each route from `start_m` on; "convoy": one
  /// behind the other, `spacing_m` apart, the first one at `start_m`.
  std::string placement = "equal";
  double spacing_m = 60;         ///< From rear axle to rear axle.
  double start_m = 0;            ///< Arc length on the route, of the rear axle.
  double start_speed_mps = 0;    ///< They start driving, as fast as this.
  bool start_over_limit = false; ///< That may be faster than they may drive.
  double start_left_m = 0;   ///< They start so far beside the lane's middle,
  double start_turn_deg = 0; ///< and turned from it; both to the left.
  /// Whether they can talk to providers; else they send nothing and never
  /// offload.
  bool connected = true;
  /// The first one appears then, each next one so much later; who finds
  /// somebody near its place waits.
  duration appears_at{};
  duration appear_every{};
  /// Their computers die then, without goodbye; they come to rest by the plan
  /// that they have.
  std::optional<duration> fails_at;
  world::computer_options compute{}; ///< In each of them.
  /// The provider that the first of them, or each, is besides.
  std::optional<ride_options> provide;

  void visit_options(option_visitor& s) {
    using namespace std::chrono_literals;
    constexpr double max_station = std::numeric_limits<station_id::rep>::max();
    s.field("count", count, {1, 1e5});
    s.field("first_station", first_station, {1, max_station});
    if (static_cast<double>(first_station + count - 1) > max_station)
      s.refuse("first_station", "leaves too few numbers for all its vehicles.");
    s.field("routes", routes);
    if (routes.empty())
      s.refuse("routes", "must name at least one route.");
    constexpr std::array<std::string_view, 2> placements{"convoy", "equal"};
    visit_word(s, "placement", placement, "placement", placements);
    s.field("spacing_m", spacing_m, {0, 1e6});
    s.field("start_m", start_m, {0, 1e6});
    s.field("start_speed_mps", start_speed_mps, {0, 50});
    if (s.has("start_over_limit", start_over_limit))
      s.field("start_over_limit", start_over_limit);
    if (s.has("start_left_m", start_left_m != 0))
      s.field("start_left_m", start_left_m, {-10, 10});
    if (s.has("start_turn_deg", start_turn_deg != 0))
      s.field("start_turn_deg", start_turn_deg, {-90, 90});
    s.field("connected", connected);
    s.field("appears_at", appears_at, 0ns);
    s.field("appear_every", appear_every, 0ns);
    if (s.has("fails_at", fails_at.has_value()))
      s.field("fails_at", fails_at ? *fails_at : fails_at.emplace(), 1ns);
    s.moved("computer", "compute");
    s.table("compute", [this](option_visitor& t) { compute.visit_options(t); });
    if (!s.has("provide", provide.has_value()))
      return;
    s.table("provide", [this](option_visitor& t) {
      (provide ? *provide : provide.emplace()).visit_options(t);
    });
    if (!connected)
      s.refuse("provide", "has no effect in vehicles that are not connected.");
  }
};

/// How road users deal with each other.
struct traffic_options {
  /// "granted": the road grants every crossing; "perceived": nobody is granted
  /// anything, drivers judge crossings by what they perceive and by the ranks
  /// of the lanes.
  std::string crossings = "granted";

  bool grants_crossings() const { return crossings == "granted"; }

  void visit_options(option_visitor& s) {
    constexpr std::array<std::string_view, 2> rules{"granted", "perceived"};
    visit_word(s, "crossings", crossings, "rule for crossings", rules);
  }
};

} // namespace sofof::scenario
