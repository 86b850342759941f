// A record for each kind of message.
#include "offloading/tracer.hpp"

#include "messages/protocol/qos.hpp"

#include <cassert>
#include <string>

namespace sofof::offloading {

void tracer::keep(messages::trace_record&& x) {
  assert(keep_);
  x.by = by_;
  x.step = ++last_;
  keep_(std::move(x));
}

void tracer::add(step what, const messages::service_offer& x, station_id to,
                 time_point now) {
  if (!keep_)
    return;
  messages::trace_record made{
      .at = now, .what = what, .provider = x.provider, .station = to};
  for (const auto& name : x.services)
    made.services.push_back({name});
  keep(std::move(made));
}

void tracer::add(step what, const messages::service_request& x,
                 time_point now) {
  if (!keep_)
    return;
  messages::trace_record made{.at = now,
                              .what = what,
                              .provider = x.provider,
                              .station = x.station,
                              .number = x.number};
  for (const auto& name : x.services)
    made.services.push_back({name});
  keep(std::move(made));
}

void tracer::add(step what, const messages::service_response& x,
                 time_point now) {
  if (!keep_)
    return;
  messages::trace_record made{.at = now,
                              .what = what,
                              .provider = x.provider,
                              .station = x.station,
                              .number = x.number};
  for (const auto& v : x.verdicts) {
    const auto& s = v.session;
    if (v.accepted
        && (s.provider != x.provider || s.station != x.station
            || !s.is_remote()))
      break; // it cannot be meant, nor can what follows
    made.services.push_back({s.service, v.accepted ? s.counter : 0});
  }
  keep(std::move(made));
}

void tracer::add(step what, const messages::session_digest& x, time_point now) {
  if (!keep_)
    return;
  messages::trace_record made{.at = now,
                              .what = what,
                              .provider = x.provider,
                              .station = x.station,
                              .number = x.last_counter};
  for (const auto& session : x.running)
    made.services.push_back({session.service, session.counter});
  keep(std::move(made));
}

void tracer::add(step what, const messages::service_end& x, time_point now) {
  add(what, x.session, now, messages::name_of(x.reason));
}

void tracer::add(step what, const messages::session_id& x, time_point now,
                 std::string_view detail, std::uint64_t number) {
  if (!keep_)
    return;
  keep({.at = now,
        .what = what,
        .provider = x.provider,
        .station = x.station,
        .number = number,
        .services = {{x.service, x.counter}},
        .detail = std::string{detail}});
}

void tracer::add(step what, provider_id provider, station_id station,
                 time_point now, std::string_view detail,
                 std::uint64_t number) {
  if (!keep_)
    return;
  keep({.at = now,
        .what = what,
        .provider = provider,
        .station = station,
        .number = number,
        .detail = std::string{detail}});
}

} // namespace sofof::offloading
