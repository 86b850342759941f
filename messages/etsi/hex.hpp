// Octets as text.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::messages::etsi {

/// Appends two lower-case digits an octet.
void append_hex(std::string& out, std::span<const std::byte> octets);

/// @param text  Digits of either case; white space does not matter, nor does
/// 0x at the beginning.
/// @returns nothing if there is something else, or half an octet.
std::optional<std::vector<std::byte>> octets_from_hex(std::string_view text);

} // namespace sofof::messages::etsi
