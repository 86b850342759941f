// Whose word counts for less, and how long.
#include "planners/plausibility/reputation.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::planners {

namespace {

using namespace std::chrono_literals;

constexpr duration first_term = 60s;
constexpr duration longest_term = 24h;

/// Nobody knows more of them.
constexpr std::size_t most_terms = 10'000;

} // namespace

void reputation::blame(sender_id who, station_id by, time_point now) {
  const std::pair key{who, by};
  const auto before = terms_.find(key);
  if (before == terms_.end()) {
    if (terms_.size() >= most_terms)
      return;
    terms_.emplace(key, term{now + first_term, first_term});
    latest_ = std::max(latest_, now + first_term);
    return;
  }
  auto& x = before->second;
  assert(x.length >= first_term && x.length <= longest_term);
  if (now >= x.until)
    x.length = std::min(2 * x.length, longest_term);
  x.until = now + x.length;
  latest_ = std::max(latest_, x.until);
  assert(is_distrusted(who, by, now));
}

bool reputation::is_distrusted(sender_id who, station_id by,
                               time_point now) const {
  const auto holds = [&](station_id whom) {
    const auto x = terms_.find({who, whom});
    return x != terms_.end() && now < x->second.until;
  };
  return has_liars(now) && (holds(everybody) || holds(by));
}

void reputation::tidy(time_point now) {
  std::erase_if(terms_, [&](const auto& x) {
    return now - x.second.until > x.second.length;
  });
}

} // namespace sofof::planners
