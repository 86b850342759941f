// Quality of service: what was promised, what arrived, what was broken.
#pragma once

#include "messages/protocol/service.hpp"

#include <string>

namespace sofof::messages {

/// What a requester expects of a remote service; both ends are allowed.
struct qos_limits {
  duration max_latency{};      ///< From t_creation to t_receiving.
  duration max_interarrival{}; ///< Between two received results.
  /// Of the input that a result was made from, when the result is received: it
  /// counts the way up, which the latency leaves out.
  duration max_input_age = duration::max();

  bool operator==(const qos_limits&) const = default;
};

void visit_fields(auto& v, qos_limits& x) {
  v("max_latency", x.max_latency);
  v("max_interarrival", x.max_interarrival);
  v("max_input_age", x.max_input_age);
}

/// A remote result came in.
struct arrival {
  session_id session;
  time_point created; ///< Start of the cycle that made the result.
  time_point received;
  time_point input_at; ///< When the input was made that it is a result of.
};

void visit_fields(auto& v, arrival& x) {
  v("session", x.session);
  v("created", x.created);
  v("received", x.received);
  v("input_at", x.input_at);
}

enum class qos_breach : std::uint8_t {
  latency,
  input_age,
  gap,
  implausible,
  scene, ///< It allows for no result any more; no fault of the provider's.
};

constexpr qos_breach last_of(qos_breach) {
  return qos_breach::scene;
}

/// Why a result is implausible, or of no use.
struct implausibility {
  std::string why;   ///< Check, value and limit.
  std::string check; ///< The check alone.
};

/// A session broke its limits.
struct qos_violation {
  session_id session;
  qos_breach breach = qos_breach::gap;
  time_point at;
  /// Another provider runs the service as it should, or the manager has left
  /// the one that broke them already.
  bool others_hold = false;
  std::string why{};   ///< Which limit or check, its value and limit.
  std::string check{}; ///< Of an implausible result: the check alone.
};

void visit_fields(auto& v, qos_violation& x) {
  v("session", x.session);
  v("breach", x.breach);
  v("at", x.at);
  v("others_hold", x.others_hold);
  v("why", x.why);
  v("check", x.check);
}

} // namespace sofof::messages
