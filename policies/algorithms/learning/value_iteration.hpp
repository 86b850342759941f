// What the best decisions are worth when the world's laws are known.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace sofof {

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
std::vector<double> value_iteration(const finite_mdp& world, double discount,
                                    double tolerance);

} // namespace sofof
