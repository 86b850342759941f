// One experiment: everything that a scenario file can say, with defaults.
#pragma once

#include "actors/services/service_type.hpp"
#include "base/options/option_visitor.hpp"
#include "channel/channel.hpp"
#include "messages/v2x/v2x_options.hpp"
#include "policies/api/context.hpp"
#include "world/roads/street_grid.hpp"
#include "world/roads/streets.hpp"
#include "world/sensing/sensors.hpp"
#include "world/vehicle/cycle_cost.hpp"
#include "world/vehicle/vehicle.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof {

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
  double spacing_m = 60;      ///< From rear axle to rear axle.
  double start_m = 0;         ///< Arc length on the route, of the rear axle.
  double start_speed_mps = 0; ///< They start driving, as fast as this.
  /// Whether they can talk to providers; else they send nothing and never
  /// offload.
  bool connected = true;
  /// The first one appears then, each next one so much later; who finds
  /// somebody near its place waits.
  duration appears_at{};
  duration appear_every{};
  computer_options computer{}; ///< In each of them.

  void visit_options(option_visitor& s);
};

/// How road users deal with each other.
struct traffic_options {
  /// "granted": the road grants every crossing; "perceived": nobody is granted
  /// anything, drivers judge crossings by what they perceive and by the ranks
  /// of the lanes.
  std::string crossings = "granted";

  bool grants_crossings() const { return crossings == "granted"; }

  void visit_options(option_visitor& s);
};

/// A body that stands on the road, as a parked car does.
struct obstacle_options {
  point position_m;       ///< Of its middle.
  double heading_deg = 0; ///< Of its long axis, counter-clockwise from east.
  double length_m = 4.5;
  double width_m = 1.8;

  oriented_box box() const;

  void visit_options(option_visitor& s);
};

/// A sensor at the roadside.
struct roadside_options {
  point position_m;
  double heading_deg = 0; ///< Of the middle of its field of view.
  sensor_params can{.range_m = 120};

  /// @param noise  A stream of its own.
  sensor make(random_stream noise) const;

  void visit_options(option_visitor& s);
};

/// The channel between vehicles and providers.
struct network_options {
  std::string profile = "paper-sim";
  /// File with measured delays, for the profile "trace"; relative to the
  /// scenario file.
  std::string trace;
  std::shared_ptr<const channel_profile> channel; ///< The profile, resolved.

  void visit_options(option_visitor& s);
};

/// Where a provider is, and what it offers.
struct provider_options {
  std::string name = "mec";
  point position_m;           ///< pos_SP; also the centre of the area.
  double area_radius_m = 300; ///< Of the circle round the regular area.
  std::int64_t area_corners = 24;
  std::vector<point> area_m;         ///< Polygon instead of the regular area.
  double range_m = 2000;             ///< CAMs from farther away are not heard.
  std::vector<std::string> services; ///< Offered kinds; empty: all.
  std::vector<roadside_options> sensors; ///< `sensor` in the file.
  /// Radio that reaches it: vehicles are stalled, and fade, on one radio at the
  /// same times; providers without a name share one.
  std::string radio;
  std::optional<network_options> network; ///< Its own; else everybody's.
  std::optional<duration> fails_at;       ///< It dies then, without goodbye,
  std::optional<duration> returns_at;     ///< and boots again.

  /// A loaded scenario's provider has one.
  /// @throws std::invalid_argument for a bad polygon.
  polygon area() const;

  bool offers(std::string_view service) const;

  void visit_options(option_visitor& s);
};

/// How offloading is decided.
struct policy_options {
  std::shared_ptr<local_policy> lodm;   ///< Prototype; everybody has a clone.
  std::shared_ptr<central_policy> codm; ///< Prototype.

  policy_options(); ///< The paper's: "location" for both.
  void visit_options(option_visitor& s);
};

/// Rates of what is sent and written.
struct record_options {
  duration tracks_period = std::chrono::milliseconds{100};
  bool cycles = true;   ///< Write cycles.csv.
  bool tracks = true;   ///< Write tracks.csv.
  bool margins = false; ///< Write margins.csv.

  void visit_options(option_visitor& s);
};

/// The whole file.
struct scenario {
  std::string name = "scenario";
  duration length = std::chrono::minutes{10}; ///< `duration` in the file.
  std::int64_t seed = 1;
  std::string map_file; ///< `map`; relative to the scenario file.
  bool grid = false;    ///< A generated street grid instead.
  street_grid_params grid_params;
  traffic_options traffic;
  std::vector<fleet_options> fleets;
  std::vector<obstacle_options> obstacles; ///< `obstacle` in the file.
  sensor_params sensors;                   ///< Of every vehicle.
  std::vector<provider_options> providers;
  network_options network;
  v2x_options v2x; ///< What vehicles tell everybody.
  std::vector<service_type_ptr> services;
  policy_options policies;
  record_options record;

  streets_ptr world;    ///< The map, loaded.
  std::string map_text; ///< What the map's file says; empty for a grid.
  /// What the trace's file says; empty for none. There is at most one file.
  std::string trace_text;
  /// The files that all this was read from.
  std::vector<std::filesystem::path> read_from;

  /// @returns the channel between vehicles and a provider, by its place.
  const std::shared_ptr<const channel_profile>&
  channel_to(std::size_t place) const;

  /// @returns the names of the profiles in use, each once, by commas.
  std::string profiles() const;

  /// Lists everything once.
  void visit_options(option_visitor& s);
};

/// @returns the service that plans how vehicles drive; null if there is none.
const service_type* planning_service(const scenario& s);

/// @returns the effective configuration, defaults included, as a scenario
/// file; file names in it stay as they were given.
std::string to_toml(scenario what);

} // namespace sofof
