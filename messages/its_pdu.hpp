// An ITS message as it is on the air: whoever sends it encodes it, whoever
// gets it decodes it.
#pragma once

#include "messages/payload.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace sofof {

/// A CAM, CPM or MCM in UPER (messages/etsi). May come from a stranger.
struct its_pdu {
  std::vector<std::byte> octets;

  std::span<const std::byte> view() const { return octets; }
};

template <>
inline constexpr std::string_view payload_name<its_pdu> = "its_pdu";

void archive(auto& bytes, its_pdu& x) {
  bytes(x.octets);
}

template <class Inspector>
bool inspect(Inspector& f, its_pdu& x) {
  return f.object(x).fields(f.field("octets", x.octets));
}

} // namespace sofof
