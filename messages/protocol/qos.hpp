// Quality of service: what was promised, what arrived, what was broken.
#pragma once

#include "messages/protocol/service.hpp"

#include <string>

namespace sofof::messages {

/// What a requester expects of a remote service; both ends are allowed.
struct qos_limits {
  duration max_latency{};      ///< From t_creation to t_receiving.
  duration max_interarrival{}; ///< Between two received results.
};

void visit_fields(auto& v, qos_limits& x) {
  v("max_latency", x.max_latency);
  v("max_interarrival", x.max_interarrival);
}

/// A remote result came in.
struct arrival {
  session_id session;
  time_point created; ///< Start of the cycle that made the result.
  time_point received;
};

void visit_fields(auto& v, arrival& x) {
  v("session", x.session);
  v("created", x.created);
  v("received", x.received);
}

enum class qos_breach : std::uint8_t { latency, gap, implausible };

constexpr qos_breach last_of(qos_breach) {
  return qos_breach::implausible;
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
  std::string why{};   ///< Of an implausible result: check, value and limit.
  std::string check{}; ///< Likewise, the check alone.
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
