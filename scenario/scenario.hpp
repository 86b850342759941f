// One experiment: everything that a scenario file can say, with defaults.
#pragma once

#include "actors/services/service_type.hpp"
#include "base/options/option_note.hpp"
#include "base/options/option_visitor.hpp"
#include "base/protocol.hpp"
#include "channel/core_wait.hpp"
#include "messages/v2x/v2x_options.hpp"
#include "policies/api/context.hpp"
#include "scenario/fleet_options.hpp"
#include "scenario/forecast_options.hpp"
#include "scenario/obstacle_options.hpp"
#include "scenario/provider_options.hpp"
#include "world/roads/street_grid.hpp"
#include "world/roads/streets.hpp"
#include "world/sensing/sensors.hpp"
#include "world/vehicle/vehicle.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::scenario {

/// A file that a policy needs.
struct policy_file {
  std::string key;  ///< Says which, and what is in it.
  std::string copy; ///< Its name in a results folder; empty: none is kept.
  std::string text; ///< Of that copy.
  bool is_executable = false;
};

/// How offloading is decided.
struct policy_options {
  /// Prototypes: each vehicle and each provider has a clone.
  std::shared_ptr<policies::local_policy> lodm;
  std::shared_ptr<policies::central_policy> codm;
  forecast_options forecast;      ///< That LODMs may go by.
  std::vector<policy_file> files; ///< Of a loaded scenario: all they need.

  policy_options(); ///< The paper's: "location" for both.
  void visit_options(option_visitor& s);
};

/// Rates of what is sent and written.
struct record_options {
  duration tracks_period = std::chrono::milliseconds{100};
  bool cycles = true;   ///< Write cycles.csv and responses.csv.
  bool tracks = true;   ///< Write tracks.csv.
  bool margins = false; ///< Write margins.csv.
  bool plans = false;   ///< Write plans.csv.
  bool trace = false;   ///< Write protocol_trace.csv.

  void visit_options(option_visitor& s) {
    using namespace std::chrono_literals;
    s.field("tracks_period", tracks_period, protocol::control_period);
    if (tracks_period % protocol::control_period != 0ns)
      s.refuse("tracks_period", "must be a multiple of \"10ms\", a vehicle's "
                                "step.");
    s.field("cycles", cycles);
    s.field("margins", margins);
    s.field("plans", plans);
    s.field("trace", trace);
    s.field("tracks", tracks);
  }
};

/// The whole file.
struct scenario_definition {
  std::string name = "scenario";
  duration length = std::chrono::minutes{10}; ///< `duration` in the file.
  std::int64_t seed = 1;
  std::string map_file; ///< `map`; relative to the scenario file.
  bool grid = false;    ///< A generated street grid instead.
  world::street_grid_params grid_params;
  traffic_options traffic;
  std::vector<fleet_options> fleets;
  std::vector<obstacle_options> obstacles; ///< `obstacle` in the file.
  world::sensor_params sensors;            ///< Of every vehicle.
  std::vector<provider_options> providers;
  /// More of them; of a loaded scenario they are among `providers`, and so are
  /// those that ride with vehicles, as the last.
  std::optional<provider_grid_options> provider_grid;
  network_options network;
  compute_options compute; ///< Of providers that have none of their own.
  channel::host_options vehicle_host; ///< Of all vehicles, if there is one.
  messages::v2x_options v2x;          ///< What vehicles tell everybody.
  std::vector<actors::service_type_ptr> services;
  policy_options policies;
  record_options record;

  world::streets_ptr world; ///< The map, loaded.
  std::string map_text;     ///< What the map's file says; empty for a grid.
  /// What the trace's file says; empty for none. There is at most one file.
  std::string trace_text;
  /// Name, size and fingerprint of each file that programs are made of, or get.
  /// There are none where a scenario is only read, and not run.
  std::vector<std::string> program_texts;
  /// The files that all this was read from.
  std::vector<std::filesystem::path> read_from;
  std::vector<option_note> notes; ///< On the scenario's file.

  /// @returns the channel between vehicles and a provider, by its place.
  const std::shared_ptr<const channel::channel_profile>&
  channel_to(std::size_t place) const;

  /// @returns how many vehicles all fleets have.
  std::int64_t vehicles() const;

  /// @returns where the file says what a provider is, by its place.
  std::string key_of(std::size_t place) const;

  /// @returns the computers of a provider, by its place. Precondition: the
  /// scenario was loaded.
  channel::provider_compute compute_of(std::size_t place) const;

  /// @returns the names of the profiles in use, each once, by commas.
  std::string profiles() const;

  /// Lists everything once.
  void visit_options(option_visitor& s);
};

/// @returns the service that plans how vehicles drive; null if there is none.
const actors::service_type* planning_service(const scenario_definition& s);

/// @returns the service of that name; null if there is none.
const actors::service_type* find_service(const scenario_definition& s,
                                         std::string_view name);

/// @returns the names of the services that form a chain with the planning
/// service as the last one, in their order.
std::vector<std::string> chain_of(const scenario_definition& s);

/// @returns the place of a service in its chain, the first being 0; 0 for one
/// that is in none.
std::uint32_t place_in_chain(const scenario_definition& s,
                             const actors::service_type& type);

/// @returns the effective configuration, defaults included, as a scenario
/// file; file names in it stay as they were given.
std::string to_toml(scenario_definition what);

} // namespace sofof::scenario
