// A scenario with faults, made up of a seed.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace sofof::experiments::torture {

/// Makes up a scenario: a small town, some vehicles and providers, services,
/// policies, a channel, and what goes wrong in it. Nobody collides in it by
/// its own doing: crossings are granted, and nothing stands on the road.
/// @returns a scenario file (docs/scenarios.md), perhaps with tables of foul
/// play (docs/torture.md), that says only what differs
/// from the defaults; the same bytes for the same seed, on every host.
std::string draw(std::uint64_t seed);

/// @returns how the scenario of a seed is called.
std::string name_of(std::uint64_t seed);

} // namespace sofof::experiments::torture
