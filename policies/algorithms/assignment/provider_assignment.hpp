// The assignment as one provider sees it: who shall be served here, who
// elsewhere, who at home.
#pragma once

#include "policies/algorithms/assignment/problem.hpp"
#include "policies/api/central_view.hpp"

#include <chrono>
#include <vector>

namespace sofof::policies::assignment {

/// Options of all policies that decide so; μ is the price.
struct assignment_options : central_options {
  /// w*: results may wait so long for a worker, in the mean; > 0.
  duration wait = std::chrono::milliseconds{16};

  /// Lists the options once.
  void visit_options(option_visitor& s);
};

struct central_problem {
  problem what; ///< Of the requests and then the sessions.
  /// Of each index, this one first.
  std::vector<provider_id> providers;
};

/// Who asks may be served by any provider that it names; who is served stays or
/// goes home, as what it could win elsewhere is old, and nobody can tell it
/// whom to ask.
///
/// This provider may be busy up to `utilisation_cap` of the longest computing
/// time, which bounds the mean wait of a mixture too; what runs has room in any
/// case. Others have what is left by what they said, and a service is taken to
/// need as much of them as of this one. Links of a vehicle's chain lean on each
/// other as `leaning_of` (policies/algorithms/chains/leaning.hpp) says; one
/// that is alone counts here as if its vehicle told nothing, and elsewhere for
/// nothing.
central_problem problem_of(const central_context& context,
                           const assignment_options& options);

/// Serves here who is at home though there is room: first who is served now,
/// then who asks. For solvers that may overlook it.
void fill_room(const problem& p, std::vector<choice>& choices);

/// @returns a decision for each request and then for each session.
std::vector<central_decision> decisions_of(const central_context& context,
                                           const central_problem& asked,
                                           const solution& found);

} // namespace sofof::policies::assignment
