// Least energy with a budget of violations, without knowing any law of chance.
#include "policies/algorithms/lyapunov/drift_plus_penalty.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::policies {

std::size_t
drift_plus_penalty::choose(std::span<const planning_option> choices) const {
  assert(!choices.empty());
  std::size_t best = 0;
  auto least = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < choices.size(); ++a) {
    const auto asked = price(choices[a]);
    if (asked < least) {
      best = a;
      least = asked;
    }
  }
  return best;
}

void drift_plus_penalty::observe(const planned_cycle& cycle) {
  assert(cycle.served >= 0 && cycle.arrived >= 0);
  const auto violation = cycle.missed ? 1.0 : 0.0;
  violation_debt_ =
      std::max(violation_debt_ + violation - options_.violation_budget, 0.0);
  energy_debt_j_ =
      std::max(energy_debt_j_ + cycle.energy_j - options_.energy_budget_j, 0.0);
  backlog_ = std::max(backlog_ - cycle.served, 0.0) + cycle.arrived;
}

double drift_plus_penalty::price(const planning_option& choice) const {
  return (options_.energy_weight + energy_debt_j_) * choice.energy_j
         + violation_debt_ * choice.miss_probability - backlog_ * choice.served;
}

} // namespace sofof::policies
