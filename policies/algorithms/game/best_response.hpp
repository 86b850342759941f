// How an equilibrium is found: slot by slot, one player at a time moves to
// what is best for it.
// Source: Chen 2016, Algorithm 1.
#pragma once

#include "base/random.hpp"
#include "policies/algorithms/game/offloading_game.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace sofof::policies::game {

/// What the winner of a decision slot does.
struct update {
  std::size_t player = 0;
  choice to = locally;
};

/// One decision slot: everybody looks for an improvement, whoever found one
/// asks for the permission to move, and one of them gets it. The profile
/// stays as it is.
/// @param slot     Number of the slot; the lottery's draw.
/// @param lottery  Draws the winner; without it the first who asks wins.
/// @returns the winner's move; nullopt when nobody asks, at an equilibrium.
std::optional<update>
decision_slot(const offloading_game& game, const profile& a, std::uint64_t slot,
              const std::optional<random_stream>& lottery);

struct equilibrium {
  profile choices;
  std::size_t slots = 0; ///< In which somebody moved.
};

/// Plays slots until nobody asks any more. That it ends follows from the
/// potential; how soon, from experience: about one to one and a half slots a
/// player. Each slot takes O(N² + N·M).
/// @param start  Any profile; the paper begins with all_local().
equilibrium play(const offloading_game& game, profile start,
                 const std::optional<random_stream>& lottery);

} // namespace sofof::policies::game
