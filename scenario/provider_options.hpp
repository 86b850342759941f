// What a scenario says of its edge servers and of the air before them.
#pragma once

#include "actors/services/programs/program_options.hpp"
#include "base/geometry.hpp"
#include "base/ids.hpp"
#include "base/options/option_helpers.hpp"
#include "channel/channel_profile.hpp"
#include "channel/provider_compute.hpp"
#include "world/roads/streets.hpp"
#include "world/sensing/sensors.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::scenario {

/// A sensor at the roadside.
struct roadside_options {
  point position_m;
  double heading_deg = 0; ///< Of the middle of its field of view.
  world::sensor_params can{.range_m = 120};

  /// @param noise  A stream of its own.
  world::sensor make(random_stream noise) const;

  void visit_options(option_visitor& s) {
    s.field("position_m", position_m);
    s.field("heading_deg", heading_deg, {-360, 360});
    can.visit_options(s);
  }
};

/// The channel between vehicles and providers.
struct network_options {
  /// The profile that the file names, with what it changes in it.
  channel::channel_profile profile =
      *channel::find_channel_profile("paper_sim");
  /// File with measured delays, for the profile "trace"; relative to the
  /// scenario file.
  std::string trace;
  /// What connects processes: "direct", or "amqp" by a broker.
  std::string transport = "direct";
  /// The profile as all use it, with its trace; a loaded scenario has one.
  std::shared_ptr<const channel::channel_profile> channel;

  void visit_options(option_visitor& s);
};

/// What a provider computes with. What a file leaves out is as it was measured
/// with the provider's channel profile; a loaded scenario has everything.
struct compute_options {
  std::optional<std::string> model; ///< Its channel profile: computing times.
  std::optional<std::int64_t> workers;
  std::optional<duration> more_computing;
  std::optional<double> worker_w;      ///< Of a busy one beyond an idle one, W,
  std::optional<double> worker_idle_w; ///< and of that one.
  /// Which of these the file says in [network], their former place: those are
  /// not for providers that have a network of their own.
  struct {
    bool workers = false;
    bool more_computing = false;
  } of_network;

  void visit_options(option_visitor& s);

  /// @returns what of it counts for a provider with a network of its own.
  compute_options for_own_network() const;

  /// Fills in what is left out.
  /// @param profile  The name of the provider's channel profile.
  void complete(const std::string& profile);

  /// @returns the computers. Precondition: it is complete.
  channel::provider_compute computers() const;
};

/// Lists the names of what a provider offers.
void visit_services(option_visitor& s, std::vector<std::string>& services);
/// Lists a provider's own channel, if it has one.
void visit_own_network(option_visitor& s,
                       std::optional<network_options>& network);
/// Likewise its own computers.
void visit_own_compute(option_visitor& s,
                       std::optional<compute_options>& compute);

/// The vehicle that a provider rides with.
struct provider_carrier {
  station_id station = 0;
  std::size_t fleet = 0; ///< Its place in the file.
};

/// Where a provider is, and what it offers.
struct provider_options {
  std::string name = "mec";
  point position_m;           ///< pos_SP; also the centre of the area.
  double area_radius_m = 300; ///< Of the circle round the regular area.
  std::int64_t area_corners = 24;
  std::vector<point> area_m; ///< Polygon instead of the regular area.
  double range_m = 2000;     ///< CAMs from farther away are not heard.
  /// File of a map of its own, relative to the scenario file, or "none"; empty:
  /// the scenario's.
  std::string map;
  world::streets_ptr streets; ///< Of its own map, loaded; null: the scenario's.
  std::string map_text; ///< What the file of its own map says; empty: no file.
  std::vector<std::string> services;     ///< Their names; empty: all.
  std::vector<roadside_options> sensors; ///< `sensor` in the file.
  /// Radio that reaches it: vehicles are stalled, and fade, on one radio at the
  /// same times; providers without a name share one.
  std::string radio;
  /// What it runs in place of programs of services: `program` in the file.
  std::vector<actors::program_at_provider> programs;
  std::optional<network_options> network; ///< Its own; else everybody's.
  std::optional<compute_options> compute; ///< Likewise.
  std::optional<duration> fails_at;       ///< It dies then, without goodbye,
  std::optional<duration> returns_at;     ///< and boots again.
  /// No option: what rides is made of `ride_options`. Its place is where the
  /// vehicle starts.
  std::optional<provider_carrier> carrier;

  /// A loaded scenario's provider has one.
  /// @throws std::invalid_argument for a bad polygon.
  polygon area() const;

  /// @returns the regular area, if it lay round this point.
  polygon area_round(point centre) const;

  /// @returns how near who is surely in the regular area, m.
  double reach_m() const;

  bool offers(std::string_view service) const;

  /// Whether it has no map at all.
  bool has_no_map() const { return map == "none"; }

  void visit_options(option_visitor& s) {
    using namespace std::chrono_literals;
    s.field("name", name);
    if (name.empty())
      s.refuse("name", "must not be empty.");
    s.field("position_m", position_m);
    if (s.has("area_m", !area_m.empty())) {
      s.field("area_m", area_m);
      refuse_bad_polygon(s, "area_m", area_m);
      for (const auto key : {"area_radius_m", "area_corners"})
        if (s.has(key, false))
          s.refuse(key, "has no effect beside area_m; remove one of them.");
    } else {
      s.field("area_radius_m", area_radius_m, {1, 1e6});
      s.field("area_corners", area_corners, {3, 1000});
    }
    s.field("range_m", range_m, {0, 1e6});
    if (s.has("map", !map.empty())) {
      s.field("map", map);
      if (map.empty())
        s.refuse("map", "must be a file or \"none\"; leave it out for the "
                        "scenario's.");
    }
    visit_services(s, services);
    visit_list(s, "sensor", sensors);
    visit_list(s, "program", programs);
    if (s.has("fails_at", fails_at.has_value()))
      s.field("fails_at", fails_at ? *fails_at : fails_at.emplace(), 1ns);
    if (s.has("returns_at", returns_at.has_value())) {
      s.field("returns_at", returns_at ? *returns_at : returns_at.emplace(),
              1ns);
      if (!fails_at)
        s.refuse("returns_at", "has no effect without fails_at.");
      else if (*returns_at <= *fails_at)
        s.refuse("returns_at", "must be later than fails_at.");
    }
    if (s.has("radio", !radio.empty()))
      s.field("radio", radio);
    s.moved("network.workers", "compute.workers");
    s.moved("network.more_computing", "compute.more_computing");
    visit_own_network(s, network);
    visit_own_compute(s, compute);
  }
};

/// Providers in rows and columns, alike but for their places.
struct provider_grid_options {
  std::int64_t columns = 1;
  std::int64_t rows = 1;
  point first_m;        ///< Of the south-western one.
  double apart_m = 750; ///< Between neighbours.
  double area_radius_m = 300;
  double range_m = 2000;

  /// @returns them, row by row: `mec_0_0`, `mec_0_1` …, the row first.
  std::vector<provider_options> all() const;

  void visit_options(option_visitor& s) {
    s.field("columns", columns, {1, 1000});
    s.field("rows", rows, {1, 1000});
    s.field("first_m", first_m);
    s.field("apart_m", apart_m, {1, 1e6});
    s.field("area_radius_m", area_radius_m, {1, 1e6});
    s.field("range_m", range_m, {0, 1e6});
  }
};

} // namespace sofof::scenario
