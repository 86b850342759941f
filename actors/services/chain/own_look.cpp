// What a vehicle's own sensor looked at.
#include "actors/services/chain/own_look.hpp"

#include "base/time.hpp"
#include "messages/v2x/object_list.hpp"

namespace sofof::actors {

planners::road_look own_look(const plan_request& request,
                             const planning_world& world) {
  const auto& own = request.own;
  const auto& seen = request.seen;
  // In the middle of the body, whose reference point is the rear axle.
  const auto ahead_m = (world.car.front_m - world.car.rear_m) / 2
                       + own.speed_mps * to_seconds(seen.at - own.at);
  const auto middle =
      own.position + ahead_m * messages::unit_vector(own.heading_rad);
  return {seen.at,
          {middle, own.heading_rad, world.eyes.range_m,
           world.eyes.field_of_view_deg},
          own.speed_mps,
          seen.at,
          seen.objects,
          {},
          seen.objects.size()};
}

} // namespace sofof::actors
