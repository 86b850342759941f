// A record for each kind of message.
#include "offloading/tracer.hpp"

#include "messages/protocol/qos.hpp"

#include <cassert>
#include <string>
#include <utility>
#include <vector>

namespace sofof::offloading {

namespace {

std::vector<messages::traced_service>
without_sessions(const std::vector<messages::service_name>& names) {
  std::vector<messages::traced_service> all;
  for (const auto& name : names)
    all.push_back({name});
  return all;
}

/// What follows a verdict that cannot be meant for its vehicle counts for
/// nothing.
std::vector<messages::traced_service>
sound_verdicts(const messages::service_response& x) {
  std::vector<messages::traced_service> all;
  for (const auto& [session, accepted, why, instead] : x.verdicts) {
    if (accepted
        && (session.provider != x.provider || session.station != x.station
            || !session.is_remote()))
      break;
    all.push_back({session.service, accepted ? session.counter : 0});
  }
  assert(all.size() <= x.verdicts.size());
  return all;
}

std::vector<messages::traced_service>
named_in(const messages::session_digest& x) {
  std::vector<messages::traced_service> all;
  for (const auto& session : x.running)
    all.push_back({session.service, session.counter});
  return all;
}

} // namespace

void tracer::keep(messages::trace_record&& x) {
  assert(keep_);
  x.by = by_;
  x.step = ++last_;
  keep_(std::move(x));
}

void tracer::add(step what, const messages::service_offer& x, station_id to,
                 time_point now) {
  if (keep_)
    keep({.at = now,
          .what = what,
          .provider = x.provider,
          .station = to,
          .services = without_sessions(x.services)});
}

void tracer::add(step what, const messages::service_request& x,
                 time_point now) {
  if (keep_)
    keep({now,
          {},
          0,
          what,
          x.provider,
          x.station,
          x.number,
          without_sessions(x.services)});
}

void tracer::add(step what, const messages::service_response& x,
                 time_point now) {
  if (keep_)
    keep(
        {now, {}, 0, what, x.provider, x.station, x.number, sound_verdicts(x)});
}

void tracer::add(step what, const messages::session_digest& x, time_point now) {
  if (keep_)
    keep(
        {now, {}, 0, what, x.provider, x.station, x.last_counter, named_in(x)});
}

void tracer::add(step what, const messages::service_end& x, time_point now) {
  add(what, x.session, now, messages::name_of(x.reason));
}

void tracer::add(step what, const messages::session_id& x, time_point now,
                 std::string_view detail, std::uint64_t number) {
  if (keep_)
    keep({now,
          {},
          0,
          what,
          x.provider,
          x.station,
          number,
          {{x.service, x.counter}},
          std::string{detail}});
}

void tracer::add(step what, station_id station,
                 const messages::service_name& service,
                 const std::optional<messages::standby>& chosen,
                 time_point now) {
  const auto after = chosen ? chosen->after : duration{0};
  assert(after >= duration{0});
  add(what,
      messages::session_id{chosen ? chosen->provider : provider_id{0}, station,
                           service, 0},
      now, {}, static_cast<std::uint64_t>(after.count()));
}

void tracer::add(step what, provider_id provider, station_id station,
                 time_point now, std::string_view detail,
                 std::uint64_t number) {
  if (keep_)
    keep(
        {now, {}, 0, what, provider, station, number, {}, std::string{detail}});
}

} // namespace sofof::offloading
