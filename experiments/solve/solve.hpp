// Solves the problems of a file and says how well that went.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>

namespace sofof::experiments {

struct solve_options {
  bool cold = false; ///< Without the plan before.
  int repeat = 1;    ///< Times through the list, >= 1; for profilers.
  /// A JSON object a line and instance, of the first time through.
  std::optional<std::filesystem::path> out;
};

/// Solves the instances in order; prints times, iterations, and how many are
/// ok against the reference: violation and cost within what the file allows,
/// or reported as infeasible where nothing is feasible.
/// @throws input_error when the file cannot be used, or `out` not written.
void solve_problems(const std::filesystem::path& file,
                    const solve_options& options, std::ostream& screen);

} // namespace sofof::experiments
