// Least energy with a budget of violations, without knowing any law of chance.
#pragma once

#include <cassert>
#include <cstddef>
#include <limits>
#include <span>

namespace sofof::policies {

struct drift_plus_penalty_options {
  double energy_weight = 50;      ///< V, 1/J, ≥ 0: energy against debts.
  double violation_budget = 0.01; ///< ε, missed cycles per cycle, in [0, 1].
  /// Mean energy per cycle at most, J; without an end there is no such budget.
  double energy_budget_j = std::numeric_limits<double>::infinity();
};

/// One way to have a cycle planned, locally or by a provider.
struct planning_option {
  double energy_j = 0;         ///< E_a: expected of this cycle, in the vehicle.
  double miss_probability = 0; ///< p̂_a: forecast, in [0, 1].
  double served = 1;           ///< μ_a: expected plans that leave the backlog.
};

/// What a cycle was like.
struct planned_cycle {
  bool missed = false; ///< Its result came too late or not at all.
  double energy_j = 0;
  double served = 1;  ///< Plans that left the backlog, ≥ 0.
  double arrived = 1; ///< Plans that were asked for, ≥ 0.
};

/// Chooses per cycle the option with the least
///
///     V E_a + Z p̂_a + Y E_a − Q μ_a
///
/// where debts grow with what was spent beyond the budgets:
///
///     Z ← [Z + 1{missed} − ε]⁺,  Y ← [Y + E − Ē]⁺,  Q ← [Q − served]⁺ +
///     arrived
///
/// On every run of T cycles, whatever the forecasts were worth, the share of
/// missed cycles is at most ε + Z(T)/T. With true forecasts of independent
/// cycles the mean energy is within O(1/V) of the best possible, with debts
/// of O(V): a large V saves energy and pays its violations late.
/// O(options) per cycle. Source: Neely 2010, chapter 4.
class drift_plus_penalty {
public:
  explicit drift_plus_penalty(const drift_plus_penalty_options& options = {})
      : options_{options} {
    assert(options.energy_weight >= 0);
    assert(options.violation_budget >= 0 && options.violation_budget <= 1);
  }

  /// @param choices  At least 1.
  /// @returns the place of the best one; the first of equals, and the first at
  /// all if none has a price that is a number.
  std::size_t choose(std::span<const planning_option> choices) const;

  /// Learns what the cycle was like.
  void observe(const planned_cycle& cycle);

  double violation_debt() const { return violation_debt_; } ///< Z, cycles.
  double energy_debt_j() const { return energy_debt_j_; }   ///< Y.
  double backlog() const { return backlog_; }               ///< Q, plans.

private:
  double price(const planning_option& choice) const;

  drift_plus_penalty_options options_;
  double violation_debt_ = 0;
  double energy_debt_j_ = 0;
  double backlog_ = 0;
};

} // namespace sofof::policies
