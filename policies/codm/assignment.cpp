// CODM "assignment": the best for all who ask and all who are served.
#include "base/options/spelling.hpp"
#include "policies/algorithms/assignment/branch_and_bound.hpp"
#include "policies/algorithms/assignment/cbc.hpp"
#include "policies/algorithms/assignment/greedy_regret.hpp"
#include "policies/algorithms/assignment/min_cost_flow.hpp"
#include "policies/algorithms/assignment/provider_assignment.hpp"
#include "policies/entry.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace sofof::policies {

namespace {

constexpr auto solvers = std::to_array<std::string_view>({
    "auto",
    "branch_and_bound",
    "greedy_regret",
#ifdef SOFOF_WITH_CBC
    "cbc",
#endif
});

/// @returns where a solver is that cannot be chosen.
std::string_view where_it_is(std::string_view solver) {
  if (solver == "min_cost_flow")
    return " \"auto\" takes it wherever all demands are equal.";
  if (solver == "cbc")
    return " It is built in by cmake -DSOFOF_WITH_CBC=ON.";
  return "";
}

/// Source: see policies/algorithms/assignment; Tran & Pompili 2019 for the
/// setting.
class best_assignment final : public central_policy {
public:
  std::vector<central_decision>
  decide(const central_context& context) override {
    const auto asked = assignment::problem_of(context, options_);
    return decisions_of(context, asked, solve(asked.what));
  }
  void visit_options(option_visitor& s) override;
  double epoch_s() const override { return options_.epoch_s; }
  std::string_view name() const override { return "assignment"; }
  std::unique_ptr<central_policy> clone() const override {
    return std::make_unique<best_assignment>(*this);
  }

private:
  assignment::solution solve(const assignment::problem& p) const;

  assignment::assignment_options options_;
  std::string solver_ = "auto";
  std::int64_t nodes_ = 300'000; // of a search, at most
};

assignment::solution
best_assignment::solve(const assignment::problem& p) const {
  if (solver_ == "greedy_regret")
    return greedy_regret(p);
#ifdef SOFOF_WITH_CBC
  if (solver_ == "cbc")
    if (auto found = assignment::cbc(p, nodes_))
      return *found;
#endif
  if (solver_ == "auto")
    if (auto flow = min_cost_flow(p))
      return *flow;
  return branch_and_bound(p, nodes_).best;
}

void best_assignment::visit_options(option_visitor& s) {
  options_.visit_options(s);
  s.field("solver", solver_);
  if (std::ranges::find(solvers, solver_) == solvers.end())
    s.refuse("solver", unknown_word("solver", solver_, solvers)
                           + std::string{where_it_is(solver_)});
  s.field("nodes", nodes_, {0, 1e9});
}

} // namespace

codm_entry codm_assignment() {
  return {{"assignment",
           "Serves those who together win most by it, and tells others whom "
           "to ask.",
           "max sum g_ij x_ij - price (changes of x), with sum_i x_ij <= 1 and "
           "sum_j u_j x_ij <= U_i; here U = 2 w / (S + 2 w) for a mean wait w "
           "(M/D/1, service time S)",
           "the gains that vehicles tell with requests, what runs, computing "
           "times, how busy other providers are",
           "Tran & Pompili, TVT 68(1), 2019; Martello & Toth 1990; Fisher 1981",
           {{"epoch_s", "s", "that requests wait for each other"},
            {"price", "1", "of a change, in units of gains"},
            {"wait", "time", "for a worker that a result may have in the mean"},
            {"solver",
             "\"auto\", \"branch_and_bound\", \"greedy_regret\" or, where it "
             "is built in, \"cbc\"",
             "that seeks the best"},
            {"nodes", "1", "partial assignments that a search looks at"}}},
          filtered_by_request<best_assignment>};
}

} // namespace sofof::policies
