// Orders of strangers, each in a process of its own.
#pragma once

#include "scenario/sweep/crew.hpp"

#include <cstdint>
#include <filesystem>

namespace sofof {

/// What a run may take that somebody else ordered.
struct child_limits {
  std::uint64_t memory = 0;       ///< Octets.
  std::uint64_t largest_file = 0; ///< Of its results, octets.
};

/// @returns a share of this machine's memory for each of so many runs.
child_limits shared_limits(std::size_t runs);

/// Runs an order as `PROGRAM run` in a process of its own, so that whatever is
/// ordered harms nobody but itself: killed when it is interrupted, when it
/// takes too much, and when this process dies.
/// @throws std::runtime_error with what the program said, when it fails.
void run_as_child(const std::filesystem::path& program, const run_order& order,
                  const child_limits& limits);

} // namespace sofof
