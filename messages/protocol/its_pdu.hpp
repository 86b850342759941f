// An ITS message as it is on the air: whoever sends it encodes it, whoever
// gets it decodes it.
#pragma once

#include "base/ids.hpp"
#include "base/time.hpp"
#include "messages/protocol/payload.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace sofof::messages {

/// A CAM, CPM or MCM in UPER (messages/etsi). May come from a stranger.
struct its_pdu {
  std::vector<std::byte> octets;
  /// How far its sender's time of day is ahead of ours. Does not travel: who
  /// gets it from another host fills it in.
  duration ahead{};
  /// Whose certificate it came by, unless it comes from this process. Does not
  /// travel either.
  std::optional<sender_id> sender{};

  std::span<const std::byte> view() const { return octets; }

  /// @returns whose message it says it is; nothing if it is too short.
  std::optional<station_id> station() const {
    constexpr std::size_t begin = 2, end = 6; // of its header
    if (octets.size() < end)
      return std::nullopt;
    station_id::rep id = 0;
    for (auto i = begin; i < end; ++i)
      id = id << 8 | std::to_integer<station_id::rep>(octets[i]);
    return id;
  }
};

void visit_fields(auto& v, its_pdu& x) {
  v("octets", x.octets);
}

/// ITS messages that belong together.
struct its_pdus {
  std::vector<its_pdu> all;
};

void visit_fields(auto& v, its_pdus& x) {
  v("all", x.all);
}

} // namespace sofof::messages

template <>
inline constexpr std::string_view
    sofof::messages::payload_name<sofof::messages::its_pdu> = "its_pdu";
template <>
inline constexpr std::string_view
    sofof::messages::payload_name<sofof::messages::its_pdus> = "its_pdus";
