// Quality of service: what was promised, what arrived, what was broken.
#pragma once

#include "messages/protocol/service.hpp"

#include <string>

namespace sofof {

/// What a requester expects of a remote service; both ends are allowed.
struct qos_limits {
  duration max_latency{};      ///< From t_creation to t_receiving.
  duration max_interarrival{}; ///< Between two received results.
};

/// A remote result came in.
struct arrival {
  session_id running;
  time_point created; ///< Start of the cycle that made the result.
  time_point received;
};

enum class qos_breach : std::uint8_t { latency, gap, implausible };

/// Why a result is implausible, or of no use.
struct implausibility {
  std::string why;   ///< Check, value and limit.
  std::string check; ///< The check alone.
};

/// A running service broke its limits.
struct qos_violation {
  session_id running;
  qos_breach breach = qos_breach::gap;
  time_point at;
  /// Another provider runs the service as it should, or the manager has left
  /// the one that broke them already.
  bool others_hold = false;
  std::string why{};   ///< Of an implausible result: check, value and limit.
  std::string check{}; ///< Likewise, the check alone.
};

template <class Inspector>
bool inspect(Inspector& f, qos_limits& x) {
  return f.object(x).fields(f.field("max_latency", x.max_latency),
                            f.field("max_interarrival", x.max_interarrival));
}

template <class Inspector>
bool inspect(Inspector& f, arrival& x) {
  return f.object(x).fields(f.field("running", x.running),
                            f.field("created", x.created),
                            f.field("received", x.received));
}

template <class Inspector>
bool inspect(Inspector& f, qos_breach& x) {
  return inspect_enum(f, x, qos_breach::implausible);
}

template <class Inspector>
bool inspect(Inspector& f, qos_violation& x) {
  return f.object(x).fields(f.field("running", x.running),
                            f.field("breach", x.breach), f.field("at", x.at),
                            f.field("others_hold", x.others_hold),
                            f.field("why", x.why), f.field("check", x.check));
}

} // namespace sofof
