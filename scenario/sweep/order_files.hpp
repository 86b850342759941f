// A run as files: what is ordered, and what comes back.
#pragma once

#include "messages/work.hpp"
#include "scenario/scenario.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sofof {

/// The first one is the scenario; the others are those that it names.
inline constexpr std::string_view files_of_an_order[] = {
    "config.toml", "map.toml", "trace.txt"};

/// All files of an order together, octets, at most.
inline constexpr std::size_t largest_order = std::size_t{64} << 20;

/// The results of a run together, octets, at most.
inline constexpr std::uint64_t largest_results = std::uint64_t{8} << 30;

/// @returns what another host needs to carry the run out, in parts that can be
/// sent.
/// @throws std::runtime_error when it is too large.
std::vector<file_piece> order_of(const scenario& s);

} // namespace sofof
