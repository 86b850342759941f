// Which of a few numbered actions may be taken.
#pragma once

#include <bitset>
#include <cassert>
#include <cstddef>

namespace sofof::policies {

/// The actions that a safety shield allows, one bit each.
using action_set = std::bitset<32>;

/// @param number  At most 32.
/// @returns the set of the actions 0 to number − 1.
constexpr action_set first_actions(std::size_t number) {
  assert(number <= action_set{}.size());
  return action_set{(1ULL << number) - 1};
}

} // namespace sofof::policies
