// When a learner tries something that it does not hold for the best.
#include "policies/algorithms/learning/exploration.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::policies {

namespace {

constexpr std::uint32_t whether_lane = 0;
constexpr std::uint32_t which_lane = 1;

} // namespace

double exploration::share(std::uint64_t decisions_taken) const {
  assert(first >= 0 && first <= 1 && last >= 0 && last <= 1);
  assert(decisions > 0);
  const auto passed =
      static_cast<double>(decisions_taken) / static_cast<double>(decisions);
  return first + (last - first) * std::min(1.0, passed);
}

std::optional<std::size_t> best_action(std::span<const double> values,
                                       action_set allowed) {
  assert(values.size() <= allowed.size());
  std::optional<std::size_t> best;
  for (std::size_t action = 0; action < values.size(); ++action)
    if (allowed[action] && (!best || values[action] > values[*best]))
      best = action;
  return best;
}

std::optional<std::size_t> explore_or_best(std::span<const double> values,
                                           action_set allowed, double share,
                                           const random_stream& draws,
                                           std::uint64_t decision) {
  allowed &= first_actions(values.size());
  if (allowed.none() || draws.uniform(decision, whether_lane) >= share)
    return best_action(values, allowed);
  auto to_skip = draws.bits(decision, which_lane) % allowed.count();
  std::size_t action = 0;
  while (!allowed[action] || to_skip-- > 0)
    ++action;
  return action;
}

} // namespace sofof::policies
