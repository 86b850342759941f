// A place where a channel is worse, or better, than elsewhere.
#include "channel/network_area.hpp"

#include <stdexcept>

namespace sofof::channel {

duration place_quality::slowed(duration delay) const {
  const auto slow = delay_factor == 1
                        ? delay
                        : from_seconds(delay_factor * to_seconds(delay));
  return slow + more_delay;
}

bool network_area::contains(point p) const {
  return position_m ? distance_m(*position_m, p) <= radius_m
                    : shape_.contains(p);
}

void network_area::visit_options(option_visitor& s) {
  using namespace std::chrono_literals;
  if (s.has("name", !name.empty()))
    s.field("name", name);
  if (s.has("area_m", !area_m.empty())) {
    s.field("area_m", area_m);
    try {
      shape_ = polygon{area_m};
    } catch (const std::invalid_argument& problem) {
      s.refuse("area_m", problem.what());
    }
    for (const auto* key : {"position_m", "radius_m"})
      if (s.has(key, false))
        s.refuse(key, "has no effect beside area_m; remove one of them.");
  } else if (s.has("position_m", position_m.has_value())) {
    s.field("position_m", position_m ? *position_m : position_m.emplace());
    s.field("radius_m", radius_m, {0.1, 1e6});
  } else {
    s.refuse("area_m", "is missing: an area is a polygon, area_m, or a circle, "
                       "position_m and radius_m.");
  }
  s.field("more_delay", quality.more_delay, 0ns);
  s.field("delay_factor", quality.delay_factor, {0, 1e3});
  s.field("loss", quality.loss, {0, 1});
  if (quality == place_quality{})
    s.refuse("loss", "is missing, and the area changes nothing: say "
                     "more_delay, delay_factor or loss.");
}

place_quality quality_at(std::span<const network_area> areas, point place) {
  place_quality all;
  for (const auto& area : areas)
    if (area.contains(place)) {
      const auto& x = area.quality;
      all.more_delay += x.more_delay;
      all.delay_factor *= x.delay_factor;
      all.loss = 1 - (1 - all.loss) * (1 - x.loss);
    }
  return all;
}

} // namespace sofof::channel
