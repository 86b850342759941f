// What made a result late, or its input old.
#pragma once

#include "experiments/report/run_files.hpp"

#include <span>
#include <string>
#include <string_view>

namespace sofof::experiments::explain {

/// A part of the time from an input to its result.
struct part {
  std::string_view what; ///< In words.
  double ms = 0;
  double usual_ms = 0; ///< Its median in the results before.

  double more_ms() const { return ms - usual_ms; }
};

/// @returns whether the latency of a result counts from its input on, as a
/// service may ask for: then all parts are parts of it.
bool counts_from_input(const report::cycle_line& x);

/// @param results      Of the session, not empty, with their parts; the last
///                     one is explained.
/// @param since_input  All parts; else those since the cycle began.
/// @returns the part that took at least half of the time, else the one that
/// took most more than usual.
part longest_part(std::span<const report::cycle_line> results,
                  bool since_input);

/// @param since_input  As above.
/// @returns "wait for a worker 18.1, way down 10.1, computing 3.0, other 0.4":
/// the three longest parts of at least 0.05 ms, and what they leave of all
/// parts as printed; where rounding leaves too little, the longest is the
/// shorter by it. Nothing where none is as long.
std::string in_parts(const report::time_parts& ms, bool since_input);

} // namespace sofof::experiments::explain
