// Messages of another host, with their times on our clock.
#include "actors/remote/clock_translation.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace sofof::actors {

namespace {

/// Of a result's time: a peer may claim anything.
constexpr duration longest_part = std::chrono::hours{1};

/// @param what  Of an input or a result: ITS messages or anything else.
messages::payload on_our_clock(messages::payload what, const heartbeat& peer,
                               const network::clock_offset& clock) {
  if (const auto message = what.as<messages::its_pdu>())
    return messages::payload::of(
        messages::its_pdu{message->octets, peer.time_of_day(clock)});
  if (const auto several = what.as<messages::its_pdus>()) {
    auto all = *several;
    for (auto& one : all.all)
      one.ahead = peer.time_of_day(clock);
    return messages::payload::of(std::move(all));
  }
  return what;
}

} // namespace

messages::service_offer on_our_clock(messages::service_offer offer,
                                     const heartbeat& peer, time_point now) {
  const auto clock = peer.clock(now);
  if (clock && offer.created)
    *offer.created -= clock->ahead;
  else
    offer.created.reset();
  return offer;
}

std::optional<messages::its_pdu> on_our_clock(const messages::its_pdu& message,
                                              const heartbeat& peer,
                                              time_point now) {
  const auto clock = peer.clock(now);
  if (!clock)
    return std::nullopt;
  return messages::its_pdu{message.octets, peer.time_of_day(*clock)};
}

std::optional<messages::service_input>
on_our_clock(messages::service_input input, const heartbeat& peer,
             time_point now) {
  const auto clock = peer.clock(now);
  if (!clock)
    return std::nullopt;
  input.at -= clock->ahead;
  input.up = {{}, std::max(now - input.at, duration{0})};
  input.what = on_our_clock(std::move(input.what), peer, *clock);
  return input;
}

std::optional<messages::service_result>
on_our_clock(messages::service_result result, const heartbeat& peer,
             time_point now) {
  const auto clock = peer.clock(now);
  if (!clock)
    return std::nullopt;
  result.doubt = clock->doubt;
  result.created -= clock->ahead;
  if (result.created > now && result.created - now <= clock->doubt)
    result.created = now;
  auto& timing = result.timing;
  timing.input_at -= clock->ahead;
  if (timing.input_at > now && timing.input_at - now <= clock->doubt)
    timing.input_at = now;
  for (auto* part :
       {&timing.up.wait, &timing.up.travel, &timing.queue, &timing.computing})
    *part = std::clamp(*part, duration{0}, longest_part);
  const auto sent = result.created + timing.queue + timing.computing;
  timing.down = {{}, std::max(now - sent, duration{0})};
  result.what = on_our_clock(std::move(result.what), peer, *clock);
  return result;
}

} // namespace sofof::actors
