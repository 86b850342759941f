// The offloading game as one provider plays it.
#include "policies/algorithms/game/provider_game.hpp"

#include "policies/api/central_view.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::policies::game {

namespace {

/// Of what is shared: cost of computing alone, without unit.
constexpr double least_shared = 1e-6;
constexpr double most_shared = 10;

} // namespace

player player_of(double gain, double computing_s, duration limit) {
  assert(std::abs(gain) <= 100 && computing_s >= 0);
  const auto limit_s = std::max(to_seconds(limit), 1e-3);
  const auto shared = std::clamp(cost_weights{}.time * computing_s / limit_s,
                                 least_shared, most_shared);
  // The rest may be anything that leaves both costs above zero.
  const auto rest = 1 + std::max(0.0, -gain);
  return {.cycles = 1,
          .bits = shared,
          .local_clock_hz = 1 / (rest + shared + gain),
          .cloud_clock_hz = 1 / rest,
          .time_weight = 1,
          .received_power_w = equal_power_w,
          .lone_rate_bps = 1};
}

central_game game_of(const central_context& context, double price,
                     std::shared_ptr<const channel_model> model) {
  assert(model);
  const auto workers = std::max<std::size_t>(context.workers, 1);
  std::vector<player> players;
  profile now;
  const auto add = [&](const auto& view, double bonus, choice at) {
    const auto gain =
        local_gain(view.candidates, context.self, view.utilisation, price);
    players.push_back(player_of(
        gain + bonus, computing_s(view.utilisation, view.task, workers),
        view.task.deadline));
    now.push_back(at);
  };
  for (const auto& request : context.requests)
    add(request, 0, locally);
  for (const auto& session : context.sessions)
    add(session, price, 1 + session.worker % workers);
  return {{std::move(players), workers, std::move(model)}, std::move(now)};
}

} // namespace sofof::policies::game
