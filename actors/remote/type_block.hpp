// What makes two programs of this project understand each other.
#pragma once

#include <cstdint>
#include <string>

namespace sofof::actors {

/// @returns a fingerprint of the names of all our types, in their order: an id
/// on the wire is a position in it.
std::uint64_t fingerprint_of_types();

/// @returns how a program says which messages it speaks.
std::string spoken(std::uint32_t protocol, std::uint64_t types);

} // namespace sofof::actors
