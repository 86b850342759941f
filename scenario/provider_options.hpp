// What a scenario says of its edge servers and of the air before them.
#pragma once

#include "base/geometry.hpp"
#include "base/options/option_helpers.hpp"
#include "channel/channel.hpp"
#include "world/sensing/sensors.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof {

/// A sensor at the roadside.
struct roadside_options {
  point position_m;
  double heading_deg = 0; ///< Of the middle of its field of view.
  sensor_params can{.range_m = 120};

  /// @param noise  A stream of its own.
  sensor make(random_stream noise) const;

  void visit_options(option_visitor& s) {
    s.field("position_m", position_m);
    s.field("heading_deg", heading_deg, {-360, 360});
    can.visit_options(s);
  }
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
    if (s.has("services", !services.empty())) {
      s.field("services", services);
      if (services.empty())
        s.refuse("services", "must name at least one service; leave it out to "
                             "offer all.");
    }
    visit_list(s, "sensor", sensors);
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
    if (s.has("network", network.has_value()))
      s.table("network", [this](option_visitor& t) {
        if (!network)
          network.emplace();
        network->visit_options(t);
        if (network->channel && network->channel->replays)
          t.refuse("profile", "replays a file, which only [network] can.");
      });
  }
};

} // namespace sofof
