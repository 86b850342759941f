// What the best decisions are worth when the world's laws are known.
#include "policies/algorithms/learning/value_iteration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sofof {

namespace {

constexpr auto forbidden = -std::numeric_limits<double>::infinity();

} // namespace

std::vector<double> value_iteration(const finite_mdp& world, double discount,
                                    double tolerance) {
  std::vector<double> values(world.outcomes.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (world.outcomes[i].empty())
      values[i] = forbidden;

  const auto best = [&](std::size_t state) {
    const auto first =
        values.begin() + static_cast<std::ptrdiff_t>(state * world.actions);
    const auto value =
        *std::max_element(first, first + static_cast<int>(world.actions));
    return value == forbidden ? 0 : value;
  };
  for (double change = 2 * tolerance; change > tolerance;) {
    change = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] == forbidden)
        continue;
      double value = 0;
      for (const auto& outcome : world.outcomes[i]) {
        const auto later = outcome.next ? discount * best(*outcome.next) : 0;
        value += outcome.probability * (outcome.reward + later);
      }
      change = std::max(change, std::abs(value - values[i]));
      values[i] = value;
    }
  }
  return values;
}

} // namespace sofof
