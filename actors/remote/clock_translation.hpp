// Messages of another host, with their times on our clock.
#pragma once

#include "actors/remote/heartbeat.hpp"
#include "messages/protocol/its_pdu.hpp"
#include "messages/protocol/service.hpp"

#include <optional>

namespace sofof::actors {

/// @returns the offer; without its time as long as the peer's clock is not
/// known.
messages::service_offer on_our_clock(messages::service_offer offer,
                                     const heartbeat& peer, time_point now);

/// @returns the ITS message, with how far its sender's time of day is ahead of
/// ours; nothing as long as that is not known.
std::optional<messages::its_pdu> on_our_clock(const messages::its_pdu& message,
                                              const heartbeat& peer,
                                              time_point now);

/// @returns the input, and likewise an ITS message in it; nothing as long as
/// the peer's clock is not known.
std::optional<messages::service_input>
on_our_clock(messages::service_input input, const heartbeat& peer,
             time_point now);

/// @returns the result, with what its time is in doubt by, and likewise an ITS
/// message in it; nothing as long as the peer's clock is not known. One that
/// seems to come from the future by less than the doubt was created now.
std::optional<messages::service_result>
on_our_clock(messages::service_result result, const heartbeat& peer,
             time_point now);

} // namespace sofof::actors
