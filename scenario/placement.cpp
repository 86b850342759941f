// Where the vehicles of a scenario start.
#include "scenario/placement.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>

namespace sofof::scenario {

namespace {

/// @param place  Of a vehicle among those of its fleet on this way: 0, 1, ...
/// @param count  How many these are.
double start_of_m(const fleet_options& fleet, const world::route& way,
                  double place, double count) {
  const auto length_m = way.length_m();
  const auto room_m = length_m - (way.closed() ? 0 : fleet.start_m);
  const auto ahead_m = fleet.placement == "convoy" ? -place * fleet.spacing_m
                                                   : place * room_m / count;
  const auto s_m = fleet.start_m + ahead_m;
  if (!way.closed())
    return s_m;
  const auto lap_m = s_m - std::floor(s_m / length_m) * length_m;
  return lap_m < length_m ? lap_m : 0; // rounding
}

std::vector<world::route_ptr> ways_of(const fleet_options& fleet,
                                      const world::streets& world) {
  std::vector<world::route_ptr> ways;
  for (const auto& name : fleet.routes)
    std::ranges::copy(find_routes(world, name), std::back_inserter(ways));
  return ways;
}

/// The room that nobody else may stand in: half the gap at both ends.
oriented_box room(const placed_vehicle& v) {
  auto box = v.body();
  box.length_m += min_start_gap_m;
  return box;
}

} // namespace

oriented_box placed_vehicle::body() const {
  const auto pose = way->path().at(start_s_m);
  const point left{-std::sin(pose.heading_rad), std::cos(pose.heading_rad)};
  return world::body({.at = pose.at + left_m * left,
                      .heading_rad = pose.heading_rad + turn_rad},
                     {});
}

std::vector<world::route_ptr> find_routes(const world::streets& world,
                                          std::string_view name) {
  const auto any = name.ends_with('*');
  const auto begin = name.substr(0, name.size() - (any ? 1 : 0));
  std::vector<world::route_ptr> found;
  for (const auto& r : world.routes)
    if (any ? r->name().starts_with(begin) : r->name() == name)
      found.push_back(r);
  return found;
}

std::vector<placed_vehicle> place_vehicles(const scenario_definition& all) {
  assert(all.world);
  std::vector<placed_vehicle> placed;
  for (std::size_t f = 0; f < all.fleets.size(); ++f) {
    const auto& fleet = all.fleets[f];
    const auto ways = ways_of(fleet, *all.world);
    assert(!ways.empty());
    const auto way_of = [&](std::int64_t i) -> const world::route_ptr& {
      return ways[static_cast<std::size_t>(i) % ways.size()];
    };
    std::map<std::string_view, double> sharing, standing; // by way
    for (std::int64_t i = 0; i < fleet.count; ++i)
      ++sharing[way_of(i)->name()];
    for (std::int64_t i = 0; i < fleet.count; ++i) {
      const auto& way = way_of(i);
      const auto place = standing[way->name()]++;
      placed.push_back(
          {static_cast<station_id>(fleet.first_station + i), f, way,
           start_of_m(fleet, *way, place, sharing[way->name()]),
           fleet.appears_at + i * fleet.appear_every, fleet.start_left_m,
           fleet.start_turn_deg * std::numbers::pi / 180});
    }
  }
  return placed;
}

std::optional<std::pair<std::size_t, std::size_t>>
find_too_near(std::span<const placed_vehicle> vehicles) {
  std::vector<std::pair<oriented_box, std::size_t>> rooms; // west to east
  for (std::size_t i = 0; i < vehicles.size(); ++i)
    if (vehicles[i].appears == duration{})
      rooms.emplace_back(room(vehicles[i]), i);
  std::ranges::stable_sort(rooms, {},
                           [](const auto& r) { return r.first.centre.x_m; });
  for (auto a = rooms.begin(); a != rooms.end(); ++a) {
    const auto reach_m = std::hypot(a->first.length_m, a->first.width_m);
    for (auto b = a + 1; b != rooms.end(); ++b) {
      if (b->first.centre.x_m > a->first.centre.x_m + reach_m)
        break;
      if (overlap(a->first, b->first))
        return std::minmax(a->second, b->second);
    }
  }
  return std::nullopt;
}

} // namespace sofof::scenario
