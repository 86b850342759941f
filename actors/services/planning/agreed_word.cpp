// What a vehicle has agreed on at a crossing, as the provider that plans for it
// is told.
#include "actors/services/planning/agreed_word.hpp"

#include "planners/crossing/agreed.hpp"
#include "world/roads/unrolled_route.hpp"

#include <algorithm>

namespace sofof::actors {

bool agreed_word::on_report(const messages::decoded_mcm& word) {
  word_.reset();
  if (word.plan && word.answer
      && word.answer->second == messages::etsi::maneuver_response::pending)
    word_ = word;
  return word_.has_value();
}

std::optional<planners::agreed_drive>
agreed_word::drive(const planners::planning_input& from,
                   const world::route_ptr& way, time_point now) const {
  if (!word_)
    return std::nullopt;
  const messages::maneuver_frame frame{world_->where->frame, word_->reference,
                                       word_->at};
  const planners::agreeing_car car{from.s_m, from.speed_mps,
                                   world_->car.front_m};
  planners::crossing_view view;
  view.line_m = line_ahead_m(way, from.s_m + car.front_m);
  if (messages::to_trajectory(*word_->plan, frame, *way, from.s_m, nullptr,
                              view.drive)
      != messages::maneuver_fault::none)
    return std::nullopt;
  return planners::agreed(view, now, car);
}

/// @returns where the next crossing begins.
double agreed_word::line_ahead_m(const world::route_ptr& way,
                                 double front_m) const {
  constexpr double look_m = 200;
  const world::unrolled_route zones{way, world_->roads->lanes()->meetings()};
  auto line_m = front_m + look_m;
  zones.for_zones(front_m, line_m, [&](const world::zone& z) {
    if (z.from_m >= front_m)
      line_m = std::min(line_m, z.from_m);
    return true;
  });
  return line_m;
}

} // namespace sofof::actors
