// Whom an offloading part sends to, without knowing by what transport.
#pragma once

#include <cstdint>

namespace sofof::offloading {

/// The far end of a link, as the owner of the link numbers it. A number is
/// never given twice: who starts again is another peer.
enum class peer_id : std::uint64_t {};

} // namespace sofof::offloading
