// What the best decisions are worth when the world's laws are known.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace sofof::test {

/// One thing that may follow an action.
struct mdp_outcome {
  double probability = 1; ///< 0..1; those of an action add up to 1.
  double reward = 0;
  std::optional<std::size_t> next; ///< State; none when the episode is over.
};

/// A Markov decision process of few states.
struct finite_mdp {
  std::size_t actions = 1;
  /// By state · actions + action. An action without outcomes is not allowed.
  std::vector<std::vector<mdp_outcome>> outcomes;
};

/// @param discount   Of the next reward, 0..1; 1 only where every way ends.
/// @param tolerance  Ends when no value changes by more, > 0; the distance
///                   to the optimum is then at most γ/(1 − γ) as much.
/// @returns the value of each action that is allowed, by state · actions +
/// action; −∞ for the others.
/// Source: Sutton & Barto 2018, section 4.4.
inline std::vector<double> value_iteration(const finite_mdp& world,
                                           double discount, double tolerance) {
  constexpr auto forbidden = -std::numeric_limits<double>::infinity();
  std::vector<double> values(world.outcomes.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (world.outcomes[i].empty())
      values[i] = forbidden;

  const auto best = [&](std::size_t state) {
    const auto first =
        values.begin() + static_cast<std::ptrdiff_t>(state * world.actions);
    const auto value =
        *std::max_element(first, first + static_cast<int>(world.actions));
    return value == forbidden ? 0 : value;
  };
  for (double change = 2 * tolerance; change > tolerance;) {
    change = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] == forbidden)
        continue;
      double value = 0;
      for (const auto& outcome : world.outcomes[i]) {
        const auto later = outcome.next ? discount * best(*outcome.next) : 0;
        value += outcome.probability * (outcome.reward + later);
      }
      change = std::max(change, std::abs(value - values[i]));
      values[i] = value;
    }
  }
  return values;
}

} // namespace sofof::test
