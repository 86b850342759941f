// Which events a reader is shown, and which group each is counted in.
#pragma once

#include "messages/protocol/event_type.hpp"

#include <string_view>

namespace sofof::experiments::report {

/// @returns the group's key in apps/report/src/drive/event_groups.js; empty for
/// events that are not shown. All groups but "other" are marked on maps.
constexpr std::string_view group_of(messages::event_type what) {
  using messages::event_type;
  switch (what) {
    case event_type::violation:
      return "qos";
    case event_type::collision:
      return "collision";
    case event_type::near_miss:
      return "near_miss";
    case event_type::peer_lost:
    case event_type::provider_lost:
    case event_type::requester_lost:
      return "lost";
    case event_type::implausible:
      return "implausible";
    case event_type::result_refused:
    case event_type::refused:
    case event_type::clock_in_doubt:
    case event_type::clock_known:
    case event_type::provider_connected:
    case event_type::arrived:
      return "other";
    default:
      return "";
  }
}

/// The same by the event's name in events.jsonl.
constexpr std::string_view group_of(std::string_view name) {
  for (const auto& x : messages::event_names)
    if (x.name == name)
      return group_of(x.what);
  return "";
}

} // namespace sofof::experiments::report
