// A provider's plans for one vehicle, as MCMs suggest them.
#include "actors/services/planning/suggestion_writer.hpp"

#include "messages/v2x/encoded.hpp"

#include <utility>

namespace sofof::actors {

messages::payload suggestion_writer::write(const world::trajectory& plan,
                                           std::uint32_t session) {
  const messages::suggestion what{
      from_, position_, to_, {static_cast<std::uint16_t>(session), ++update_}};
  if (!messages::make_suggestion(what, plan, *where_, waypoints_, said_))
    return {};
  auto message = messages::encoded(said_);
  if (message.octets.empty())
    return {};
  return messages::payload::of(std::move(message));
}

} // namespace sofof::actors
