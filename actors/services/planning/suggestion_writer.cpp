// A provider's plans for one vehicle, as MCMs suggest them.
#include "actors/services/planning/suggestion_writer.hpp"

#include "messages/v2x/encoded.hpp"
#include "messages/v2x/mcm/mcm_content.hpp"

#include <utility>
#include <vector>

namespace sofof::actors {

messages::payload suggestion_writer::write(const world::trajectory& plan,
                                           std::uint32_t session, point place) {
  const messages::suggestion what{
      from_, place, to_, {static_cast<std::uint16_t>(session), ++update_}};
  // Room that is used again.
  static thread_local messages::etsi::mcm said;
  static thread_local std::vector<messages::maneuver_waypoint> waypoints;
  if (!messages::make_suggestion(what, plan, *where_, waypoints, said))
    return {};
  auto message = messages::encoded(said);
  if (message.octets.empty())
    return {};
  return messages::payload::of(std::move(message));
}

} // namespace sofof::actors
