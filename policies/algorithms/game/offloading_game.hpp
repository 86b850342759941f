// The multi-user offloading game: everybody computes locally or offloads over
// one of several channels, and minds their own cost alone.
#pragma once

#include "policies/algorithms/game/channel_model.hpp"
#include "policies/algorithms/game/player.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace sofof::policies::game {

/// What a player chooses: 0 to compute locally, or channel 1 … M.
using choice = std::size_t;
inline constexpr choice locally = 0;

/// Everybody's choice, in the order of the players.
using profile = std::vector<choice>;

/// Share of its cost that a player must save before it moves: far above
/// rounding, so that every move lowers the potential, and far below what
/// anybody would notice.
inline constexpr double least_saving = 1e-9;

/// The game. A channel is whatever players crowd: of a radio cell, or a whole
/// provider. All channels are alike to a player but for who else is there.
class offloading_game {
public:
  /// @param channels  M ≥ 1.
  /// @param model     Not null.
  offloading_game(std::vector<player> players, std::size_t channels,
                  std::shared_ptr<const channel_model> model);

  const std::vector<player>& players() const { return players_; }
  std::size_t channels() const { return channels_; }
  const channel_model& model() const { return *model_; }

  /// Everybody computes locally: where the paper's algorithm begins.
  profile all_local() const { return profile(players_.size(), locally); }

  /// Weight on each channel: what a station measures and tells everybody.
  /// @returns M + 1 sums; that of computing locally is always 0.
  /// Source: Chen 2016, ρ_m in section IV-A.
  std::vector<double> loads(const profile& a) const;

  /// Weight that player n would receive from the others if it chose `c`.
  /// Source: Chen 2016, μ_n.
  double received(const profile& a, std::size_t n, choice c) const;

  /// The most weight that player n may receive such that offloading is still
  /// beneficial; negative when it never is.
  /// Source: Chen 2016, T_n of Lemmas 1 and 2.
  double threshold(std::size_t n) const { return thresholds_[n]; }

  /// Cost of player n, s and J weighed.
  /// Source: Chen 2016, eq. (12).
  double cost(const profile& a, std::size_t n) const;

  /// The choice that is cheapest for player n while the others stay; of equal
  /// channels the first. O(N + M).
  /// @param loads  Those of the profile.
  /// @returns nullopt when it saves less than `least_saving`.
  std::optional<choice> improvement(const profile& a, std::size_t n,
                                    const std::vector<double>& loads) const;

private:
  double cost_of(std::size_t n, choice c, double received) const;

  std::vector<player> players_;
  std::size_t channels_;
  std::shared_ptr<const channel_model> model_;
  std::vector<double> weights_;
  std::vector<double> local_costs_;
  std::vector<double> thresholds_;
};

} // namespace sofof::policies::game
