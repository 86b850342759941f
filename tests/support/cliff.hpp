// Cliff walking: 4 rows of 12 cells, a cliff between start and goal.
#pragma once

#include <cstddef>
#include <optional>

namespace sofof::test {

inline constexpr std::size_t cliff_columns = 12;
inline constexpr std::size_t cliff_states = 4 * cliff_columns;
inline constexpr std::size_t cliff_actions = 4; // up, right, down, left
inline constexpr std::size_t cliff_start = 3 * cliff_columns;
inline constexpr std::size_t cliff_goal = cliff_states - 1;

struct cliff_step {
  double reward;
  std::optional<std::size_t> next; ///< None at the goal.
};

/// Sutton & Barto 2018, example 6.6.
inline cliff_step step_on_cliff(std::size_t state, std::size_t action) {
  const auto row = state / cliff_columns;
  const auto column = state % cliff_columns;
  if (action == 0 && row > 0)
    state -= cliff_columns;
  if (action == 1 && column + 1 < cliff_columns)
    ++state;
  if (action == 2 && row < 3)
    state += cliff_columns;
  if (action == 3 && column > 0)
    --state;
  if (state == cliff_goal)
    return {-1, std::nullopt};
  if (state > cliff_start)
    return {-100, cliff_start};
  return {-1, state};
}

/// @param decide  From a state to an action.
/// @returns the sum of rewards from the start on, of 100 steps at most.
template <class Decide>
double walk_the_cliff(Decide decide) {
  double total = 0;
  std::optional<std::size_t> state = cliff_start;
  for (int steps = 0; state && steps < 100; ++steps) {
    const auto [reward, next] = step_on_cliff(*state, decide(*state));
    total += reward;
    state = next;
  }
  return total;
}

} // namespace sofof::test
