// Learns with a neural network what actions are worth.
#pragma once

#include "base/random.hpp"
#include "policies/algorithms/learning/action_set.hpp"
#include "policies/algorithms/learning/adam.hpp"
#include "policies/algorithms/learning/dueling_network.hpp"
#include "policies/algorithms/learning/exploration.hpp"
#include "policies/algorithms/learning/replay.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::policies {

struct dqn_options {
  network_shape shape = {};              ///< At most 32 actions.
  double discount = 0.95;                ///< Of the next reward, 0..1.
  double rate = 1e-3;                    ///< Of Adam, > 0.
  std::size_t batch = 64;                ///< ≥ 1
  std::size_t memory = 10'000;           ///< Experiences, ≥ batch.
  std::uint64_t target_copy_every = 200; ///< Steps of training, ≥ 1.
  exploration explore = {1, 0.01, 10'000};
};

/// Deep Q-network, double and dueling: each experience adds to a memory, of
/// which a batch is drawn and the values moved by one step of Adam towards
///
///   r + γ Q⁻(s′, a*),   a* the best of the actions allowed in s′ by Q,
///
/// Q⁻ being Q as it was at the last of some regular copies. Decides
/// ε-greedily. The same seed and experiences give the same decisions.
///
/// Features should be about −1..1, and the worth of a state not far beyond
/// tens, or it learns slowly. There is no proof that it settles: judge it
/// frozen, on other seeds than it was trained with. A decision costs
/// O(width²), learning from an experience 5 · batch times as much.
///
/// Sources: Mnih et al. 2015, algorithm 1; van Hasselt, Guez & Silver 2016
/// (double); Wang et al. 2016 (dueling).
class dqn {
public:
  dqn(const dqn_options& options, const random_stream& draws);

  /// Decides, exploring; counts the decision.
  /// @param state  Its features.
  /// @returns nullopt when no action is allowed.
  std::optional<std::size_t> choose(std::span<const double> state,
                                    action_set allowed);

  /// Decides by what is known.
  std::optional<std::size_t> best(std::span<const double> state,
                                  action_set allowed);

  /// Remembers, and makes a step of training once there is a batch.
  void learn(const experience& lived);

  /// @returns what every action is worth in a state, until the next call.
  std::span<const double> values(std::span<const double> state);

  /// The network and how far learning is: a restored learner decides alike. It
  /// has no memory of experiences, and Adam starts anew.
  std::string snapshot() const;
  /// @returns why the text is no snapshot of a network of this shape, and then
  /// all stays as it was; else nullopt.
  std::optional<std::string> restore(std::string_view snapshot);

private:
  void draw_batch();
  void set_targets();
  void train();

  dqn_options options_;
  random_stream exploring_;
  random_stream drawing_;
  dueling_network network_;
  dueling_network target_;
  adam optimiser_;
  replay memory_;
  std::uint64_t decisions_ = 0;
  std::uint64_t steps_ = 0; // of training

  // Work space.
  network_pass single_;
  network_pass here_;
  network_pass there_;
  network_pass there_by_target_;
  Eigen::MatrixXd states_;
  Eigen::MatrixXd next_states_;
  Eigen::MatrixXd slopes_;
  Eigen::VectorXd gradient_;
  std::vector<std::size_t> places_; // in memory, of the batch
  std::vector<std::size_t> actions_;
  std::vector<double> targets_;
};

} // namespace sofof::policies
