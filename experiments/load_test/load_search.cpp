// Doubling, then halving.
#include "experiments/load_test/load_search.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::experiments::load_test {

namespace {

/// What is left between too many and carried is this part of what is carried.
constexpr std::int64_t fineness = 10;

} // namespace

load_search::load_search(std::int64_t first, std::int64_t most)
    : first_{first}, most_{most} {
  assert(first > 0);
  assert(most >= first);
}

std::optional<std::int64_t> load_search::next() const {
  if (too_many_) {
    const auto gap = *too_many_ - carried_;
    if (gap <= std::max<std::int64_t>(1, carried_ / fineness))
      return std::nullopt;
    return carried_ + gap / 2;
  }
  if (carried_ == most_)
    return std::nullopt;
  return carried_ == 0 ? first_ : std::min(2 * carried_, most_);
}

void load_search::add(std::int64_t tried, bool was_carried) {
  assert(tried > carried_);
  assert(!too_many_ || tried < *too_many_);
  if (was_carried)
    carried_ = tried;
  else
    too_many_ = tried;
}

} // namespace sofof::experiments::load_test
