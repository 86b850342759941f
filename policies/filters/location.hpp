// The paper's decisions: offload where enough of the way lies ahead.
// Source: Dehler & Buchholz 2025, section on location-based decisions.
#pragma once

#include "policies/api/filter.hpp"
#include "policies/api/notes.hpp"

#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace sofof::policies {

/// What a vehicle has before it in an area.
struct area_stay {
  std::span<const point> way; ///< From the first waypoint to the last inside.
  double time_s = 0;          ///< At constant speed; infinity when standing.
};

/// The part of a route before it first leaves an area.
/// @param route      Waypoints from the vehicle on, m.
/// @param speed_mps  Current speed; below 0.1 counts as standing, and the way
///                   is the first waypoint.
/// @param enough_s   It may be cut short once its time exceeds this.
/// @returns nullopt when the first waypoint is outside or there is none.
/// Source: Dehler & Buchholz 2025, eq. (1).
std::optional<area_stay>
stay_in_area(std::span<const point> route, const polygon& area,
             double speed_mps,
             double enough_s = std::numeric_limits<double>::infinity());

/// Way that a path covers near a point before it leaves the disc round it.
/// @param path      Waypoints from the vehicle on, m.
/// @param enough_m  Counting may stop once this is exceeded.
/// @returns m; 0 when the path begins outside.
double distance_in_disc_m(std::span<const point> path, point centre,
                          double radius_m, double enough_m);

/// A provider may be asked as soon as the planned path stays long enough
/// within r_off of it.
class near_provider final : public local_filter {
public:
  std::string_view objection(const local_context& context,
                             const provider_view& provider) const override;
  void visit_options(option_visitor& s) override;
  static std::vector<option_info> parameters();
  std::string_view name() const override { return "location"; }
  std::unique_ptr<local_filter> clone() const override;

private:
  double radius_m_ = 300;      // r_off
  double min_distance_m_ = 50; // d_min
};

/// A request may be accepted when the vehicle will stay in the offloading area
/// long enough, on the streets of the map.
class stays_in_area final : public central_filter {
public:
  std::string_view objection(const central_context& context,
                             const request_view& request) const override;
  void visit_options(option_visitor& s) override;
  static std::vector<option_info> parameters();
  std::string_view name() const override { return "location"; }
  std::unique_ptr<central_filter> clone() const override;

private:
  duration min_time_ = std::chrono::seconds{5}; // t_min
  double map_tolerance_m_ = 3.0;
};

} // namespace sofof::policies
