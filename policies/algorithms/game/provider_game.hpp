// The offloading game as one provider plays it for all who ask and all who are
// served.
#pragma once

#include "policies/algorithms/game/offloading_game.hpp"
#include "policies/api/context.hpp"

#include <memory>

namespace sofof::policies::game {

/// Everybody is heard alike, as a provider does not know distances: power 1 at
/// the provider, and noise 20 dB below it.
inline constexpr double equal_power_w = 1;
inline constexpr double noise_w = 0.01;

/// One who asks or is served, in units of gains (policies/api/gain.hpp). What
/// is shared is computing: alone on a worker it costs λ_T S/τ, crowded more.
/// All else that computing here or on board costs does not depend on others, so
/// that a player without others wins exactly its gain.
/// @param gain         Over computing on board, alone; |gain| ≤ 100.
/// @param computing_s  S ≥ 0, mean computing time of a result.
/// @param limit        τ, of its latency.
player player_of(double gain, double computing_s, duration limit);

struct central_game {
  offloading_game game; ///< Of the requests and then the sessions.
  profile now;          ///< Requests at home, sessions on their workers.
};

/// Channels are the workers of this provider. Other providers are none: to a
/// player all channels are alike.
/// @param price  By which who is served wins more than it says: a change has to
///               be worth it.
/// @param model  Not null.
central_game game_of(const central_context& context, double price,
                     std::shared_ptr<const channel_model> model);

} // namespace sofof::policies::game
