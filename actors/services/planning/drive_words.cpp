// What vehicles say of their ways and drives, in MCMs.
#include "actors/services/planning/drive_words.hpp"

#include "base/protocol.hpp"
#include "world/roads/route_finder.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace sofof::actors {
namespace {

/// The largest that may be on roads without a permit, m: Directive 96/53/EC,
/// Annex I. Who does not tell its size may have it.
constexpr double longest_m = 18.75, widest_m = 2.55;

} // namespace

std::vector<point> authority(const world::route& way, double s_m,
                             std::optional<double> stop_at_m) {
  constexpr double least_m = 2; // less has no direction
  const auto told_m =
      std::clamp(stop_at_m.value_or(s_m + protocol::authority_m) - s_m, least_m,
                 protocol::authority_m);
  return way.waypoints(s_m, told_m, protocol::authority_spacing_m);
}

planners::claimed_drive drive_of(const messages::decoded_mcm& word,
                                 const messages::geo_frame& earth,
                                 double rear_m) {
  planners::claimed_drive drive;
  if (!word.plan || word.plan->step_ms < 1)
    return drive;
  drive.from = word.at + std::chrono::milliseconds{word.plan->start_ms};
  drive.step = std::chrono::milliseconds{word.plan->step_ms};
  const auto length_m = word.length_m.value_or(longest_m);
  const auto width_m = word.width_m.value_or(widest_m);
  const auto middle_m = length_m / 2 - rear_m;
  for (const auto& p : word.plan->points) {
    const auto heading = earth.to_map_heading(p.heading, word.reference);
    if (!heading)
      return {};
    const auto axle =
        word.reference
        + earth.to_map_axes({p.x_cm / 100.0, p.y_cm / 100.0}, word.reference);
    const point ahead{std::cos(*heading), std::sin(*heading)};
    drive.bodies.push_back(
        {axle + middle_m * ahead, *heading, length_m, width_m});
  }
  return drive;
}

world::trajectory told_rest(const world::trajectory& drive, time_point now) {
  constexpr double told_s = 30;
  auto left = world::rest_of(drive, now);
  std::erase_if(left.points, [](const auto& p) { return p.t_s > told_s; });
  if (left.points.size() < 2)
    left.points.clear();
  return left;
}

bool is_claim(const messages::decoded_mcm& word) {
  return word.plan && word.answer
         && word.answer->second == messages::etsi::maneuver_response::accept;
}

std::string_view objection_to(std::span<const point> route,
                              const world::streets& known) {
  constexpr auto told = static_cast<std::size_t>(protocol::authority_m
                                                 / protocol::route_spacing_m);
  if (known.map.lanes().empty())
    return "no map present";
  // As far as inputs tell the way.
  if (!world::find_route(known.routes,
                         route.first(std::min(route.size(), told))))
    return "route is not on the map";
  return {};
}

} // namespace sofof::actors
