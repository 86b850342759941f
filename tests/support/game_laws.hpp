// What theory says of an offloading game, to hold its players' choices to.
#pragma once

#include "policies/algorithms/game/offloading_game.hpp"

#include <cstddef>

namespace sofof::test {

/// @returns the cost of all players together, s and J weighed.
inline double total_cost(const policies::game::offloading_game& game,
                         const policies::game::profile& a) {
  double sum = 0;
  for (std::size_t n = 0; n < a.size(); ++n)
    sum += game.cost(a, n);
  return sum;
}

/// Falls with every improvement of anybody, by as much weight as the mover is
/// spared times its own; computing locally counts as receiving one's threshold.
/// Rounding hides the moves of players who weigh less than about 1e-8 of
/// others. Source: Chen 2016, eqs. (16) and (31).
inline double potential(const policies::game::offloading_game& game,
                        const policies::game::profile& a) {
  double sum = 0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    auto alone = game.all_local();
    alone[n] = 1;
    const auto weight = game.loads(alone)[1];
    const auto level = a[n] == policies::game::locally
                           ? game.threshold(n)
                           : 0.5 * game.received(a, n, a[n]);
    sum += weight * level;
  }
  return sum;
}

/// @returns whether nobody can improve: a Nash equilibrium.
inline bool is_equilibrium(const policies::game::offloading_game& game,
                           const policies::game::profile& a) {
  const auto on_channels = game.loads(a);
  for (std::size_t n = 0; n < a.size(); ++n)
    if (game.improvement(a, n, on_channels))
      return false;
  return true;
}

/// Players who offload and pay no more than they would locally.
/// Source: Chen 2016, Definition 1.
inline std::size_t beneficial_users(const policies::game::offloading_game& game,
                                    const policies::game::profile& a) {
  const auto locally = game.all_local();
  std::size_t count = 0;
  for (std::size_t n = 0; n < a.size(); ++n)
    count += a[n] != policies::game::locally
             && game.cost(a, n) <= game.cost(locally, n);
  return count;
}

} // namespace sofof::test
