// Counting through all splits, and climbing down by single moves.
#include "policies/algorithms/splits/split_search.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::policies {

bool is_few(std::span<const std::vector<service_place>> places) {
  std::size_t splits = 1;
  for (const auto& of_one : places)
    if (splits *= of_one.size(); splits > most_looked_at)
      return false;
  assert(splits > 0);
  return true;
}

chain_split best_split(std::span<const std::vector<service_place>> places,
                       const split_cost& cost) {
  assert(std::ranges::none_of(places, &std::vector<service_place>::empty));
  std::vector<std::size_t> digits(places.size());
  chain_split split(places.size()), best;
  double least = 0;
  while (true) {
    for (std::size_t k = 0; k < places.size(); ++k)
      split[k] = places[k][digits[k]];
    if (const auto x = cost(split); best.empty() || x < least) {
      best = split;
      least = x;
    }
    std::size_t k = 0;
    while (k < places.size() && ++digits[k] == places[k].size())
      digits[k++] = 0;
    if (k == places.size())
      return best;
  }
}

chain_split greedy_split(std::span<const std::vector<service_place>> places,
                         chain_split from, const split_cost& cost) {
  assert(places.size() == from.size());
  auto least = cost(from);
  while (true) {
    auto best = from;
    for (std::size_t k = 0; k < places.size(); ++k)
      for (const auto& place : places[k]) {
        auto moved = from;
        moved[k] = place;
        if (const auto x = cost(moved); x < least) {
          best = moved;
          least = x;
        }
      }
    if (best == from)
      return from;
    from = best;
  }
}

} // namespace sofof::policies
