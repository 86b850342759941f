// Learns from a table of states and actions what each is worth.
#pragma once

#include "base/random.hpp"
#include "policies/algorithms/learning/action_set.hpp"
#include "policies/algorithms/learning/exploration.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::policies {

struct q_learning_options {
  std::size_t states = 1;
  std::size_t actions = 2; ///< At most 32.
  double discount = 0.95;  ///< Of the next reward, 0..1.
  /// Part of the error that one sample mends, 0..1. Without a value it falls
  /// with the number n of samples of this state and action so far, as
  /// 1 / (1 + n)^0.7: slow enough to forget the start, quick enough to settle.
  std::optional<double> learning_rate = std::nullopt;
  exploration explore = {};
};

/// What became of an action.
struct q_sample {
  std::size_t state = 0;
  std::size_t action = 0;
  double reward = 0;               ///< Finite.
  std::optional<std::size_t> next; ///< State; none when the episode is over.
  action_set next_allowed;         ///< Where none is, nothing more is hoped.
};

/// Q-learning: Q(s, a) += α (r + γ max Q(s′, ·) − Q(s, a)), the maximum over
/// the actions allowed in s′. Decides ε-greedily. Both cost O(actions).
///
/// With the falling rate Q tends to the optimum if every action is tried in
/// every state for ever (Watkins & Dayan 1992; rates of this form: Even-Dar &
/// Mansour 2003). Every value is learned on its own, so a table of thousands
/// of states wants hundreds of thousands of samples.
///
/// Source: Sutton & Barto 2018, section 6.5.
class q_learning {
public:
  q_learning(const q_learning_options& options, const random_stream& draws);

  /// Decides, exploring; counts the decision.
  /// @param state  < states.
  /// @returns nullopt when no action is allowed.
  std::optional<std::size_t> choose(std::size_t state, action_set allowed);

  /// Decides by what is known.
  std::optional<std::size_t> best(std::size_t state, action_set allowed) const;

  void learn(const q_sample& sample);

  /// @returns what every action is worth in a state.
  std::span<const double> values(std::size_t state) const;

  /// All that was learned: a restored learner goes on alike.
  std::string snapshot() const;
  /// @returns why the text is no snapshot of a table of this size, and then all
  /// stays as it was; else nullopt.
  std::optional<std::string> restore(std::string_view snapshot);

private:
  std::size_t cell(std::size_t state, std::size_t action) const {
    return state * options_.actions + action;
  }

  q_learning_options options_;
  random_stream draws_;
  std::vector<double> values_;         // by cell
  std::vector<std::uint64_t> samples_; // by cell
  std::uint64_t decisions_ = 0;
};

} // namespace sofof::policies
