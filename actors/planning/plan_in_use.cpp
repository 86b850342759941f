// The plan that a vehicle follows, whoever made it.
#include "actors/planning/plan_in_use.hpp"

#include "actors/planning/plan_request.hpp"
#include "messages/etsi/uper.hpp"
#include "messages/its_pdu.hpp"
#include "messages/v2x/coordination.hpp"

namespace sofof {

std::shared_ptr<const trajectory>
plan_in_use(const payload& result, station_id me, const route& way,
            double s_guess_m, const datum& where, time_point now,
            const trajectory* before) {
  if (auto own = result.as<trajectory>())
    return own->is_sound() ? own : nullptr;
  const auto message = result.as<its_pdu>();
  etsi::mcm suggestion;
  if (!message || !etsi::decode(message->view(), suggestion))
    return nullptr;
  auto plan = std::make_shared<trajectory>();
  const auto fault = read_suggestion(suggestion, me, way, s_guess_m, where, now,
                                     before, *plan);
  return fault == maneuver_fault::none ? plan : nullptr;
}

bool is_suggestion(const payload& result, station_id me) {
  const auto message = result.as<its_pdu>();
  etsi::mcm suggestion;
  return message && etsi::decode(message->view(), suggestion)
         && suggests_plan(suggestion, me);
}

} // namespace sofof
