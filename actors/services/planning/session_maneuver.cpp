// What an MCM says of a session.
#include "actors/services/planning/session_maneuver.hpp"

#include <cstdint>

namespace sofof::actors {

messages::etsi::termination_status status_of(messages::end_reason why) {
  using enum messages::etsi::termination_status;
  switch (why) {
    case messages::end_reason::left_area:
    case messages::end_reason::handed_over:
    case messages::end_reason::released:
    case messages::end_reason::shutdown:
      return regular_end;
    case messages::end_reason::cam_timeout:
    case messages::end_reason::no_data:
      return abort_by_timeout;
    case messages::end_reason::qos_latency:
    case messages::end_reason::qos_input_age:
    case messages::end_reason::qos_gap:
      return abort_by_constraint_violation;
    case messages::end_reason::refused:
    case messages::end_reason::revoked:
    case messages::end_reason::implausible:
      return abort_by_reject;
    case messages::end_reason::peer_lost:
      break;
  }
  return reason_unknown;
}

messages::maneuver_name name_of_maneuver(const messages::session_id& running) {
  return {static_cast<std::uint16_t>(running.counter), 0};
}

} // namespace sofof::actors
