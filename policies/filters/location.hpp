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

/// Time that a route spends in an area before it first leaves it, at constant
/// speed.
/// @param route      Waypoints from the vehicle on, m.
/// @param speed_mps  Current speed; below 0.1 counts as standing, which is
///                   ours.
/// @param enough_s   Counting may stop once this is exceeded.
/// @returns s; infinity when standing; nullopt when the first waypoint is
///          outside or there is none.
/// Source: Dehler & Buchholz 2025, eq. (1).
std::optional<double>
time_in_area_s(std::span<const point> route, const polygon& area,
               double speed_mps,
               double enough_s = std::numeric_limits<double>::infinity());

/// The same in an area that moves at constant velocity: each waypoint counts
/// by where the area is when the vehicle comes there. Who stands is left by the
/// area some time, to within a metre of its way.
/// @param velocity_mps  Of the area, east and north; below 0.1 it counts as
///                      standing.
/// @returns as above; infinity when both stand.
std::optional<double>
time_in_area_s(std::span<const point> route, const polygon& area,
               point velocity_mps, double speed_mps,
               double enough_s = std::numeric_limits<double>::infinity());

/// Way that a path covers near a point before it leaves the disc round it: the
/// sum of its steps to waypoints nearer than the radius, up to the first that
/// is not. Where the path begins does not matter.
/// @param path      Waypoints from the vehicle on, m.
/// @param enough_m  Counting may stop once this is exceeded.
/// @returns m.
/// Source: Dehler & Buchholz 2025, algorithm 1.
double distance_in_disc_m(std::span<const point> path, point centre,
                          double radius_m, double enough_m);

/// The same near a point that moves at constant velocity, for a vehicle that
/// keeps its speed: each waypoint counts by where the point is when the vehicle
/// comes there.
/// @param velocity_mps  Of the point, east and north; below 0.1 it counts as
///                      standing.
/// @param speed_mps     Of the vehicle; below 0.1 counts as 0.1.
double distance_in_disc_m(std::span<const point> path, point centre,
                          point velocity_mps, double speed_mps, double radius_m,
                          double enough_m);

/// A provider may be asked as soon as the planned path stays long enough
/// within r_off of it.
class near_provider final : public local_filter {
public:
  reason objection(const local_context& context,
                   const provider_view& provider) const override;
  void visit_options(option_visitor& s) override;
  static std::vector<option_info> parameters();
  std::string_view name() const override { return "location"; }
  std::unique_ptr<local_filter> clone() const override;

private:
  double radius_m_ = 300;      // r_off
  double min_distance_m_ = 50; // d_min, ours
};

/// A request may be accepted when its route is on the streets of the map, and
/// stays in the offloading area long enough.
class stays_in_area final : public central_filter {
public:
  reason objection(const central_context& context,
                   const request_view& request) const override;
  void visit_options(option_visitor& s) override;
  static std::vector<option_info> parameters();
  std::string_view name() const override { return "location"; }
  std::unique_ptr<central_filter> clone() const override;

private:
  duration min_time_ = std::chrono::seconds{5}; // t_min, ours
  double map_tolerance_m_ = 3.0;
};

} // namespace sofof::policies
