// Numbers that nobody can guess.
#pragma once

#include <string>

namespace sofof::network {

/// @returns 32 octets from the system's source of randomness, never the same.
/// @throws network_error when there is none.
std::string draw_nonce();

} // namespace sofof::network
