// Files with planning problems to solve, as JSON: see docs/planner.md.
#pragma once

#include "planners/problems/path_ocp.hpp"
#include "planners/problems/velocity_ocp.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace sofof::experiments {

/// What is known to be right about an instance.
struct reference_solution {
  bool feasible = true;
  double cost = 0;
};

/// What both kinds of instance have besides the problem.
struct instance_info {
  bool continues = true; ///< The vehicle drove on from the one before.
  bool nominal = true;   ///< Later ones go on from here; else it is a what-if.
  int step = 0;          ///< In its drive; the vehicle drives on step by step.
  std::optional<reference_solution> reference;
};

/// A problem with the numbers that it looks at.
struct path_instance {
  instance_info info;
  planners::path_problem problem;
  std::vector<double> curvature, wanted;
  std::vector<std::vector<double>> lo, hi; ///< By discs.
  std::vector<planners::disc_corridor> discs;
};

struct velocity_instance {
  instance_info info;
  planners::velocity_problem problem;
  std::vector<double> w_max, wanted, curvature, earliest, latest;
};

/// Instances in the order of the file. Pointers, since problems look at the
/// numbers beside them.
template <class Instance>
using instances = std::vector<std::unique_ptr<Instance>>;

struct problem_file {
  std::variant<instances<path_instance>, instances<velocity_instance>> list;
  double violation = 1e-3; ///< From here on a plan is not ok.
  double cost_share = 0.01;
};

/// Reads a file. Values are not judged, that is the solver's task: a null in
/// a list of numbers becomes NaN, and lists may have any length.
/// @throws input_error when it cannot be read, is no JSON, or lacks a field,
/// or a field is of the wrong type.
problem_file load_problems(const std::filesystem::path& file);

} // namespace sofof::experiments
