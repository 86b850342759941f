// Judges how cars of ours drive in scenarios of CommonRoad.
#pragma once

#include "experiments/judge/verdict.hpp"

#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace sofof::experiments::judge {

struct judge_options {
  std::optional<std::filesystem::path> out; ///< For files; a folder.
  std::vector<std::string> changes;         ///< KEY=VALUE, of each scenario.
};

/// One planning problem of one file, or a file that was refused.
struct judged {
  std::string file, scenario, problem;
  verdict found;
  double way_m = 0;     ///< Driven.
  std::string limit;    ///< Of the vehicle model, which is not kept; empty:
                        ///< all are.
  std::string solution; ///< The name of its file; empty: there is none.
};

/// Judges files, one after the other.
class judge {
public:
  explicit judge(judge_options options) : options_{std::move(options)} {}

  /// Drives each planning problem of a file. Into the folder go, if there is
  /// one, for each its scenario and map, which `sofof run` takes, and, where
  /// the goal was reached, a solution.
  /// @returns a row for each problem, or one that says why there is none; it
  /// never throws because of what is in the file.
  /// @throws input_error when something cannot be written.
  std::vector<judged> look_at(const std::string& file);

private:
  std::vector<judged> try_file(const std::string& file);
  judged try_problem(const maps::imported_map& map,
                     const maps::commonroad_scene& scene,
                     const maps::planning_problem& problem,
                     const std::string& file);
  void write(const std::string& name, const std::string& text) const;
  std::string new_name(const std::string& wanted);

  judge_options options_;
  std::set<std::string> names_; // of scenarios so far
};

/// How many were judged, and how.
struct judged_counts {
  std::size_t all = 0, own_fault = 0;
  std::vector<std::size_t> by_outcome; ///< In the order of `outcome`.

  explicit judged_counts(std::span<const judged> rows);
  std::size_t of(outcome x) const {
    return by_outcome[static_cast<std::size_t>(x)];
  }
};

} // namespace sofof::experiments::judge
