// What capacities are worth, and how much an assignment can be worth at most.
#include "policies/algorithms/assignment/lagrangian_bound.hpp"

#include <algorithm>

namespace sofof::policies::assignment {

namespace {

constexpr int max_steps = 300;
/// After so many steps without a lower bound, steps are halved.
constexpr int patience = 10;

/// The bound at given prices, and how much of each capacity would stay unsold:
/// its derivative by the prices.
struct market {
  double bound;
  Eigen::ArrayXXd unsold;
};

market sell(const reduced_problem& s, const Eigen::ArrayXXd& prices) {
  market result{prices.sum(),
                Eigen::ArrayXXd::Ones(prices.rows(), prices.cols())};
  for (int v = 0; v < s.vehicles(); ++v) {
    choice chosen;
    double best = 0;
    for (int i = 0; i < s.providers(); ++i) {
      if (s.advantage(v, i) == 0)
        continue;
      const auto m = margin(s, prices, v, i);
      if (m > best) {
        best = m;
        chosen = i;
      }
    }
    if (!chosen)
      continue;
    result.bound += best;
    for (int k = 0; k < s.resources(); ++k)
      result.unsold(*chosen, k) -= s.shares[k](v, *chosen);
  }
  return result;
}

} // namespace

double margin(const reduced_problem& s, const Eigen::ArrayXXd& prices,
              int vehicle, int provider) {
  double result = s.advantage(vehicle, provider);
  for (int k = 0; k < s.resources(); ++k)
    result -= prices(provider, k) * s.shares[k](vehicle, provider);
  return result;
}

lagrangian_bound price_capacities(const reduced_problem& s, double reached) {
  Eigen::ArrayXXd prices = Eigen::ArrayXXd::Zero(s.providers(), s.resources());
  lagrangian_bound best{prices, sell(s, prices).bound};
  double boldness = 1;
  int without_success = 0;
  for (int step = 0; step < max_steps; ++step) {
    const auto m = sell(s, prices);
    if (m.bound < best.bound) {
      best = {prices, m.bound};
      without_success = 0;
    } else if (++without_success == patience) {
      boldness /= 2;
      without_success = 0;
    }
    const auto steepness = m.unsold.square().sum();
    if (best.bound - reached <= s.rounding || steepness == 0)
      return best;
    const auto length = boldness * (m.bound - reached) / steepness;
    prices = (prices - length * m.unsold).max(0);
  }
  return best;
}

} // namespace sofof::policies::assignment
