// Decision slots until nobody wants to move.
#include "policies/algorithms/game/best_response.hpp"

#include <utility>
#include <vector>

namespace sofof::policies::game {

std::optional<update>
decision_slot(const offloading_game& game, const profile& a, std::uint64_t slot,
              const std::optional<random_stream>& lottery) {
  const auto loads = game.loads(a);
  std::vector<update> requests;
  for (std::size_t n = 0; n < a.size(); ++n)
    if (const auto to = game.improvement(a, n, loads))
      requests.push_back({n, *to});
  if (requests.empty())
    return std::nullopt;
  if (!lottery)
    return requests.front();
  const auto ticket =
      lottery->uniform(slot) * static_cast<double>(requests.size());
  return requests[static_cast<std::size_t>(ticket)];
}

equilibrium play(const offloading_game& game, profile start,
                 const std::optional<random_stream>& lottery) {
  equilibrium found{std::move(start)};
  while (const auto move =
             decision_slot(game, found.choices, found.slots, lottery)) {
    found.choices[move->player] = move->to;
    ++found.slots;
  }
  return found;
}

} // namespace sofof::policies::game
