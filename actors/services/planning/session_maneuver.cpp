// What an MCM says of a session.
#include "actors/services/planning/session_maneuver.hpp"

#include <cstdint>

namespace sofof {

etsi::termination_status status_of(end_reason why) {
  using enum etsi::termination_status;
  switch (why) {
    case end_reason::left_area:
    case end_reason::handed_over:
    case end_reason::released:
    case end_reason::shutdown:
      return regular_end;
    case end_reason::cam_timeout:
    case end_reason::no_data:
      return abort_by_timeout;
    case end_reason::qos_latency:
    case end_reason::qos_gap:
      return abort_by_constraint_violation;
    case end_reason::refused:
    case end_reason::revoked:
    case end_reason::implausible:
      return abort_by_reject;
    case end_reason::peer_lost:
      break;
  }
  return reason_unknown;
}

maneuver_name name_of_maneuver(const session_id& running) {
  return {static_cast<std::uint16_t>(running.counter), 0};
}

} // namespace sofof
