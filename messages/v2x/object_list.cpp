// What stations tell of bodies that they see, whatever the message.
#include "messages/v2x/object_list.hpp"

#include <algorithm>

namespace sofof::messages {

object_list brought_together(station_id from, time_point generated,
                             std::span<const timed_object> objects) {
  object_list seen{.from = from, .at = generated, .objects = {}};
  seen.generated = generated;
  if (objects.empty())
    return seen;
  seen.at = std::ranges::max(objects, {}, &timed_object::at).at;
  for (auto [at, what, id] : objects) {
    const auto moved_m = what.speed_mps * to_seconds(seen.at - at);
    what.centre = what.centre + moved_m * unit_vector(what.heading_rad);
    seen.objects.push_back(what);
    seen.ids.push_back(id);
  }
  return seen;
}

} // namespace sofof::messages
