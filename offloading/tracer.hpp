// Keeps the trace of one part of the protocol, if a run wants it.
#pragma once

#include "messages/protocol/record.hpp"
#include "messages/protocol/service.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>

namespace sofof::offloading {

/// Makes a `trace_record` of each step that it is told, and numbers them.
/// Nothing at all, if it has no sink.
class tracer {
public:
  using step = messages::trace_step;
  using sink = std::function<void(messages::record&&)>;

  /// @param keep  Gets the records; empty: none are made.
  tracer(messages::trace_part by, sink keep)
      : by_{by}, keep_{std::move(keep)} {}

  /// @param to  Whom an offer is sent to, or who has got it.
  void add(step what, const messages::service_offer& x, station_id to,
           time_point now);
  void add(step what, const messages::service_request& x, time_point now);
  void add(step what, const messages::service_response& x, time_point now);
  void add(step what, const messages::session_digest& x, time_point now);
  void add(step what, const messages::service_end& x, time_point now);

  /// @param number  See `messages::trace_record`.
  void add(step what, const messages::session_id& x, time_point now,
           std::string_view detail = {}, std::uint64_t number = 0);

  /// @param chosen  Who stands by; nullopt: nobody.
  void add(step what, station_id station, const messages::service_name& service,
           const std::optional<messages::standby>& chosen, time_point now);

  /// What concerns no session.
  void add(step what, provider_id provider, station_id station, time_point now,
           std::string_view detail = {}, std::uint64_t number = 0);

private:
  void keep(messages::trace_record&& x);

  messages::trace_part by_;
  sink keep_;
  std::uint64_t last_ = 0;
};

/// @param port  Gets the records, if any are wanted; outlives the tracer.
template <class Port>
tracer::sink sink_of(bool is_wanted, Port& port) {
  if (!is_wanted)
    return {};
  return [&port](messages::record&& x) { port.record(std::move(x)); };
}

} // namespace sofof::offloading
