// What a learner remembers of the past, to learn from it more than once.
#include "policies/algorithms/learning/replay.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::policies {

void replay::add(const experience& lived) {
  assert(lived.state.size() == features_);
  assert(lived.next.empty() || lived.next.size() == features_);
  const auto place = added_++ % capacity_;
  if (place == entries_.size()) {
    entries_.emplace_back();
    states_.resize(states_.size() + 2 * features_);
  }
  entries_[place] = {lived.action, lived.reward, lived.next.empty(),
                     lived.next_allowed};
  const auto state =
      states_.begin() + static_cast<std::ptrdiff_t>(2 * features_ * place);
  std::ranges::copy(lived.next, std::ranges::copy(lived.state, state).out);
}

experience replay::operator[](std::size_t place) const {
  assert(place < size());
  const auto& kept = entries_[place];
  const auto states = std::span{states_}.subspan(2 * features_ * place);
  return {states.first(features_), kept.action, kept.reward,
          kept.over ? std::span<const double>{}
                    : states.subspan(features_, features_),
          kept.next_allowed};
}

} // namespace sofof::policies
