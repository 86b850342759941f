// Durations as people write them: "50ms", "1.5s", "30min", "2h".
#pragma once

#include "base/time.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace sofof {

/// Reads a decimal number and, right behind it, its unit: ns, us, ms, s, min
/// or h.
/// @returns nullopt for anything else, and for what is not a whole number of
/// nanoseconds or more than about 292 years.
std::optional<duration> parse_duration(std::string_view text);

/// Writes a duration with the largest fitting unit, exactly: parsing the text
/// gives the same duration.
std::string print_duration(duration d);

} // namespace sofof
