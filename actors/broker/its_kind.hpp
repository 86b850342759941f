// What ITS messages are called on a broker.
#pragma once

#include "messages/protocol/its_pdu.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string_view>

namespace sofof::actors::wire {

/// What an ITS message is on the broker.
struct its_kind {
  std::uint8_t message_id; ///< In its header.
  std::uint16_t mid;
  std::string_view subject;
  std::chrono::milliseconds ttl;
};

/// Source: uulm-mrm/v2x_etsi_asn1 at 9177969.
inline constexpr its_kind its_kinds[] = {
    {14, 2049, "cpm", std::chrono::milliseconds{100}},
    {2, 2050, "cam", std::chrono::milliseconds{1000}},
    {20, 2052, "mcm", std::chrono::milliseconds{1000}},
};

/// @returns which one it is; null: none of these.
inline const its_kind* kind_of(const messages::its_pdu& x) {
  if (x.octets.size() < 2)
    return nullptr;
  const auto id = std::to_integer<std::uint8_t>(x.octets[1]);
  const auto* at = std::ranges::find(its_kinds, id, &its_kind::message_id);
  return at == std::end(its_kinds) ? nullptr : at;
}

} // namespace sofof::actors::wire
