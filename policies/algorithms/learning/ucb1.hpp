// A bandit that tries what is promising or little known.
#pragma once

#include "policies/algorithms/learning/action_set.hpp"

#include <cassert>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::policies {

/// Learns which of a few arms gives the highest mean reward, by optimism: an
/// arm of k of the t pulls so far, with mean reward m, is worth
///
///   m + √(2 ln t / k).
///
/// Its regret after t pulls is at most Σ (8 ln t / Δ + (1 + π²/3) Δ), over
/// the arms whose mean is Δ > 0 below the best (Auer's theorem 1), if rewards
/// of an arm are independent and alike. A choice costs O(arms).
///
/// Source: Auer, Cesa-Bianchi & Fischer 2002, figure 1.
class ucb1 {
public:
  /// @param arms  At most 32.
  explicit ucb1(std::size_t arms) : arms_(arms) {
    assert(arms <= action_set{}.size());
  }

  /// @returns an arm without pulls, of these the first; else the arm that is
  /// worth most; nullopt when none is allowed.
  std::optional<std::size_t> choose(action_set allowed) const;

  /// @param arm     < arms.
  /// @param reward  0..1.
  void learn(std::size_t arm, double reward);

  std::string snapshot() const;
  /// @returns why the text is no snapshot of as many arms, and then all stays
  /// as it was; else nullopt.
  std::optional<std::string> restore(std::string_view snapshot);

private:
  struct arm {
    double total = 0; // of the rewards
    std::uint64_t pulls = 0;
  };
  std::vector<arm> arms_;
  std::uint64_t pulls_ = 0;
};

} // namespace sofof::policies
