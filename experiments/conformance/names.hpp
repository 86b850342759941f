// What breaches call the things that steps are about.
#pragma once

#include "base/time.hpp"
#include "messages/protocol/service.hpp"
#include "messages/protocol/trace.hpp"

#include <fmt/format.h>

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace sofof::experiments::conformance {

/// @returns e.g. "trajectory_planning#7 of station 101 at provider 1".
inline std::string session_in(provider_id provider, station_id station,
                              const messages::traced_service& what) {
  return fmt::format("{}#{} of station {} at provider {}", what.name.view(),
                     what.counter, station, provider);
}

/// The same, of a step that is about one session.
inline std::string session_in(const messages::trace_record& x) {
  return session_in(x.provider, x.station,
                    x.services.empty() ? messages::traced_service{}
                                       : x.services.front());
}

/// What a duty to close a session, and one to tell the other side, is called.
/// @param session  As `session_in` calls it.
inline std::string end_of(const std::string& session) {
  return "closing " + session;
}
inline std::string end_to(const std::string& session) {
  return "service_end of " + session;
}

/// For which reasons something may end, each in one instant.
using reasons = std::map<std::string, time_point, std::less<>>;

/// @param ends  A step that tells for which reason something ends.
inline bool is_given(const messages::trace_record& ends, const reasons& all) {
  const auto i = all.find(ends.detail);
  return i != all.end() && i->second == ends.at;
}
inline bool is_for(const messages::trace_record& ends,
                   messages::end_reason reason) {
  return ends.detail == messages::name_of(reason);
}

/// @param reason  The name of an end's reason.
/// @returns whether a session that ended for it has ended as it should.
inline bool is_planned(std::string_view reason) {
  using messages::end_reason;
  for (auto r = end_reason{}; r <= messages::last_of(r);
       r = static_cast<end_reason>(static_cast<int>(r) + 1))
    if (messages::name_of(r) == reason)
      return messages::is_planned(r);
  return false;
}

} // namespace sofof::experiments::conformance
