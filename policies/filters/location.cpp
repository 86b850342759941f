// The paper's decisions: offload where enough of the way lies ahead.
#include "policies/filters/location.hpp"

#include "policies/entry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sofof::policies {

namespace {

constexpr double slowest_mps = 0.1;

bool stands(point velocity_mps) {
  return !(std::hypot(velocity_mps.x_m, velocity_mps.y_m) >= slowest_mps);
}

/// @returns how long a point stays in an area that moves.
double time_until_left_s(point where, const polygon& area, point velocity_mps,
                         double enough_s) {
  const auto step_s = 1 / std::hypot(velocity_mps.x_m, velocity_mps.y_m);
  double passed_s = 0;
  for (std::size_t k = 1; !(passed_s > enough_s); ++k) {
    const auto next_s = static_cast<double>(k) * step_s;
    if (!area.contains(where - next_s * velocity_mps))
      break;
    passed_s = next_s;
  }
  return passed_s;
}

} // namespace

std::optional<double> time_in_area_s(std::span<const point> route,
                                     const polygon& area, double speed_mps,
                                     double enough_s) {
  if (route.empty() || !area.contains(route.front()))
    return std::nullopt;
  if (speed_mps < slowest_mps)
    return std::numeric_limits<double>::infinity();
  const auto enough_m = enough_s * speed_mps;
  double passed_m = 0;
  for (std::size_t i = 1;
       i < route.size() && !(passed_m > enough_m) && area.contains(route[i]);
       ++i)
    passed_m += distance_m(route[i - 1], route[i]);
  return passed_m / speed_mps;
}

std::optional<double> time_in_area_s(std::span<const point> route,
                                     const polygon& area, point velocity_mps,
                                     double speed_mps, double enough_s) {
  if (stands(velocity_mps))
    return time_in_area_s(route, area, speed_mps, enough_s);
  if (route.empty() || !area.contains(route.front()))
    return std::nullopt;
  if (speed_mps < slowest_mps)
    return time_until_left_s(route.front(), area, velocity_mps, enough_s);
  double passed_s = 0;
  for (std::size_t i = 1; i < route.size() && !(passed_s > enough_s); ++i) {
    const auto there_s =
        passed_s + distance_m(route[i - 1], route[i]) / speed_mps;
    if (!area.contains(route[i] - there_s * velocity_mps))
      break;
    passed_s = there_s;
  }
  return passed_s;
}

double distance_in_disc_m(std::span<const point> path, point centre,
                          point velocity_mps, double speed_mps, double radius_m,
                          double enough_m) {
  if (stands(velocity_mps))
    return distance_in_disc_m(path, centre, radius_m, enough_m);
  const auto drives_mps = std::max(speed_mps, slowest_mps);
  double passed_m = 0;
  for (std::size_t i = 1; i < path.size() && passed_m <= enough_m; ++i) {
    const auto there_m = passed_m + distance_m(path[i - 1], path[i]);
    const auto middle = centre + (there_m / drives_mps) * velocity_mps;
    if (!(distance_m(path[i], middle) < radius_m)) // nor what is no number
      break;
    passed_m = there_m;
  }
  return passed_m;
}

double distance_in_disc_m(std::span<const point> path, point centre,
                          double radius_m, double enough_m) {
  double passed_m = 0;
  for (std::size_t i = 1; i < path.size() && passed_m <= enough_m; ++i) {
    if (!(distance_m(path[i], centre) < radius_m)) // nor what is no number
      break;
    passed_m += distance_m(path[i - 1], path[i]);
  }
  return passed_m;
}

reason near_provider::objection(const local_context& context,
                                const provider_view& provider) const {
  const auto passed_m = distance_in_disc_m(
      context.path, provider.at, provider.velocity_mps, context.speed_mps,
      std::min(radius_m_, provider.reach_m.value_or(radius_m_)),
      min_distance_m_);
  if (passed_m > min_distance_m_)
    return {};
  return {"path leaves r_off or ends before d_min", passed_m, min_distance_m_,
          "m"};
}

void near_provider::visit_options(option_visitor& s) {
  s.field("radius_m", radius_m_, {0, 1e6});
  s.field("min_distance_m", min_distance_m_, {0, 1e6});
}

std::vector<option_info> near_provider::parameters() {
  return {{"radius_m", "m", "r_off, of the disc round the provider"},
          {"min_distance_m", "m",
           "d_min; the way ahead must stay longer than this within r_off; the "
           "paper has no value, 50 is ours"}};
}

std::unique_ptr<local_filter> near_provider::clone() const {
  return std::make_unique<near_provider>(*this);
}

reason stays_in_area::objection(const central_context& context,
                                const request_view& request) const {
  if (context.map.lanes().empty())
    return "no map present";
  if (!context.map.near_lanes(request.route, map_tolerance_m_))
    return "route is not on the map";
  const auto enough_s = to_seconds(min_time_);
  const auto time_s =
      time_in_area_s(request.route, context.area, context.area_velocity_mps,
                     request.speed_mps, enough_s);
  if (!time_s)
    return "outside the area";
  if (!(*time_s >= enough_s)) // nor what is no number
    return {"t_in_area < t_min", *time_s, enough_s, "s"};
  return {};
}

void stays_in_area::visit_options(option_visitor& s) {
  s.field("min_time", min_time_, duration{0});
  s.field("map_tolerance_m", map_tolerance_m_, {0, 100});
}

std::vector<option_info> stays_in_area::parameters() {
  return {{"min_time", "time",
           "t_min; the vehicle must stay at least this long in the area; the "
           "paper has no value, 5 s is ours"},
          {"map_tolerance_m", "m",
           "so near to a lane must be every waypoint of the route; ours"}};
}

std::unique_ptr<central_filter> stays_in_area::clone() const {
  return std::make_unique<stays_in_area>(*this);
}

local_filter_entry local_filter_location() {
  return {
      {"location",
       "Lets through where the way ahead stays long enough near a provider.",
       "d_passed > d_min, the way on the planned path before it leaves the "
       "disc of radius r_off round the provider",
       "the planned path, where providers are",
       "Dehler & Buchholz, IEEE RA-L 10(5), 2025", near_provider::parameters()},
      unfiltered<local_filter, near_provider>};
}

central_filter_entry central_filter_location() {
  return {
      {"location", "Lets vehicles through that stay long enough in the area.",
       "the route is on the map; and t_in_area >= t_min, the way on the route "
       "before it leaves the area by the present speed",
       "the route and the speed that requests tell, a map",
       "Dehler & Buchholz, IEEE RA-L 10(5), 2025", stays_in_area::parameters()},
      unfiltered<central_filter, stays_in_area>};
}

} // namespace sofof::policies
