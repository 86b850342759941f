// What a scenario says of a provider that rides with a vehicle.
#pragma once

#include "base/options/option_helpers.hpp"
#include "scenario/provider_options.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::scenario {

/// Vehicles that are providers besides: an edge server on board, whose area
/// moves with the vehicle.
struct ride_options {
  std::string name = "leader";
  /// "first": the first vehicle of the fleet; "all": each, `NAME_STATION`.
  std::string cars = "first";
  double area_radius_m = 150; ///< Of the circle round the regular area.
  std::int64_t area_corners = 24;
  double range_m = 300;              ///< CAMs from farther away are not heard.
  std::vector<std::string> services; ///< As of a provider, likewise
  std::string radio;                 ///< these.
  std::optional<network_options> network;
  std::optional<compute_options> compute;

  bool is_in_all() const { return cars == "all"; }

  /// @returns the provider in this vehicle, without a place.
  provider_options in_vehicle(station_id carrier, std::size_t fleet) const;

  void visit_options(option_visitor& s) {
    s.field("name", name);
    if (name.empty())
      s.refuse("name", "must not be empty.");
    constexpr std::array<std::string_view, 2> who{"all", "first"};
    visit_word(s, "cars", cars, "choice of cars", who);
    s.field("area_radius_m", area_radius_m, {1, 1e6});
    s.field("area_corners", area_corners, {3, 1000});
    s.field("range_m", range_m, {0, 1e6});
    visit_services(s, services);
    if (s.has("radio", !radio.empty()))
      s.field("radio", radio);
    visit_own_network(s, network);
    visit_own_compute(s, compute);
  }
};

} // namespace sofof::scenario
