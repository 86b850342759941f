// Costs, potential and best responses of the offloading game.
#include "policies/algorithms/game/offloading_game.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace sofof::policies::game {

offloading_game::offloading_game(std::vector<player> players,
                                 std::size_t channels,
                                 std::shared_ptr<const channel_model> model)
    : players_{std::move(players)}, channels_{channels}, model_{
                                                             std::move(model)} {
  assert(channels_ >= 1 && model_);
  for (const auto& p : players_) {
    weights_.push_back(model_->weight(p));
    local_costs_.push_back(local_cost(p));
    thresholds_.push_back(model_->received_at(p, beneficial_rate_bps(p)));
  }
}

std::vector<double> offloading_game::loads(const profile& a) const {
  std::vector<double> sums(channels_ + 1, 0.0);
  for (std::size_t n = 0; n < a.size(); ++n)
    if (a[n] != locally)
      sums[a[n]] += weights_[n];
  return sums;
}

// Adds up what is there instead of taking one's own weight off the sum: the
// received powers of near and far players differ by more than a double holds.
double offloading_game::received(const profile& a, std::size_t n,
                                 choice c) const {
  if (c == locally)
    return 0;
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (i != n && a[i] == c)
      sum += weights_[i];
  return sum;
}

double offloading_game::cost(const profile& a, std::size_t n) const {
  return cost_of(n, a[n], received(a, n, a[n]));
}

std::optional<choice>
offloading_game::improvement(const profile& a, std::size_t n,
                             const std::vector<double>& loads) const {
  // One's own channel counts with one's own weight: staying there would be no
  // improvement anyway.
  const auto least = std::min_element(loads.begin() + 1, loads.end());
  const auto emptiest = static_cast<choice>(least - loads.begin());

  const auto offloaded = cost_of(n, emptiest, *least);
  const auto best = offloaded < local_costs_[n] ? emptiest : locally;
  const auto enough = (1 - least_saving) * cost(a, n);
  if (std::min(offloaded, local_costs_[n]) < enough)
    return best;
  return std::nullopt;
}

double offloading_game::cost_of(std::size_t n, choice c,
                                double received) const {
  if (c == locally)
    return local_costs_[n];
  return offloading_cost(players_[n], model_->rate_bps(players_[n], received));
}

} // namespace sofof::policies::game
