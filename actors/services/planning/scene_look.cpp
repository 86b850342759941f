// The own detections, the crossing's line, and who has priority there.
#include "actors/services/planning/scene_look.hpp"

#include "actors/services/planning/plan_request.hpp"
#include "planners/safety/scene_response.hpp"

#include <algorithm>
#include <vector>

namespace sofof::actors {

namespace {

/// Bodies may be nearer than they are seen by so many standard deviations.
constexpr auto noise_sigmas = 3.0;

std::vector<world::perceived_object>
widened(std::vector<world::perceived_object> seen,
        const world::sensor_params& eyes) {
  const auto all_round_m = 2 * noise_sigmas * eyes.position_noise_m;
  for (auto& x : seen) {
    x.length_m += all_round_m;
    x.width_m += all_round_m;
  }
  return seen;
}

/// No service that may respond later than this is offloaded.
constexpr auto most_s = 5.0;

bool has_priority(const plan_request& request, const planning_world& world) {
  const auto& agreed = request.crossing;
  return world.crossings_granted
         || (agreed && agreed->binds && !agreed->drive.empty());
}

} // namespace

std::optional<offloading::safe_response>
look_at(const messages::service_input& latest, const planning_world& world) {
  const auto request = latest.what.as<plan_request>();
  const auto way = request ? world.streets->find(request->way) : nullptr;
  if (!way)
    return std::nullopt;
  const auto& own = request->from;
  const auto objects = widened(request->seen.objects, world.eyes);
  const planners::safety_scene scene{.way = *way,
                                     .s_m = own.s_m,
                                     .d_m = own.d_m,
                                     .turned_rad = own.heading_error_rad,
                                     .speed_mps = own.speed_mps,
                                     .objects = objects,
                                     .stop_at_m = request->stop_at_m(world.car),
                                     .has_priority =
                                         has_priority(*request, world)};
  const auto found =
      planners::longest_safe_response(scene, world.rss, world.car, most_s);
  return offloading::safe_response{from_seconds(found.longest_s),
                                   found.because};
}

std::optional<offloading::safe_response>
look_at_all(const messages::service_input& latest,
            const planning_world& world) {
  const auto seen = look_at(latest, world);
  const auto request = latest.what.as<plan_request>();
  if (!seen || !request->found.scene)
    return seen;
  const auto way = world.streets->find(request->way);
  const auto& own = request->from;
  // A told scene names no road user that keeps to an agreed drive, so a window
  // that binds gives priority over nobody in it.
  const auto told = planners::longest_safe_response(
      request->found.scene->scene,
      {own.s_m, own.d_m, own.heading_error_rad, own.speed_mps,
       way->path().curvature_1pm(own.s_m), world.crossings_granted},
      world.rss, world.car, most_s);
  const auto age =
      std::max(latest.at - latest.sensed.value_or(latest.at), duration{0});
  const auto longest = from_seconds(told.longest_s);
  return longest < seen->longest
             ? offloading::safe_response{longest, told.because, age}
             : offloading::safe_response{seen->longest, seen->because, age};
}

} // namespace sofof::actors
