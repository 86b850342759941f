// Who else has seen a body, and who has looked and has not.
#include "planners/plausibility/testimony.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::planners {

namespace {

using namespace std::chrono_literals;

/// A confirmation counts until it would have been repeated: T_GenCpmMax and a
/// CPM's period. Source: TS 103 324 V2.1.1, section 6.1.2.
constexpr duration counts_for = 1250ms;

/// By then a body is told of again.
constexpr duration told_again = 1100ms;

/// A sensor misses a body now and then, but not so often in a row.
constexpr int looks_in_a_row = 3;

/// Nobody needs more of them.
constexpr std::size_t most_observers = 8;

} // namespace

void testimony::confirm(const road_observer& who, time_point at) {
  std::erase_if(denied_, [&](const denial& x) { return x.by == who; });
  if (who.is_ours) {
    denied_.clear();
    denials_ = 0;
  } else if (who.sender == tells_) {
    return;
  }
  was_confirmed_ = true;
  const auto before = std::ranges::find(confirmed_, who, &confirmation::by);
  if (before != confirmed_.end())
    before->at = std::max(before->at, at);
  else if (confirmed_.size() < most_observers)
    confirmed_.push_back({who, at});
  else
    *std::ranges::min_element(confirmed_, {}, &confirmation::at) = {who, at};
  assert(confirmed_.size() <= most_observers);
  assert(std::ranges::find(denied_, who, &denial::by) == denied_.end());
}

void testimony::deny(const road_observer& who, time_point at, bool is_sure) {
  if (!is_denied())
    first_denied_ = at;
  std::erase_if(confirmed_, [&](const confirmation& x) { return x.by == who; });
  if (who.is_ours) {
    denials_ = std::min(denials_ + 1, looks_in_a_row);
    return;
  }
  const auto before = std::ranges::find(denied_, who, &denial::by);
  if (before != denied_.end())
    before->counts |= is_sure || at - before->since >= told_again;
  else if (denied_.size() < most_observers)
    denied_.push_back({who, at, is_sure});
  assert(denied_.size() <= most_observers && is_denied());
  assert(std::ranges::find(confirmed_, who, &confirmation::by)
         == confirmed_.end());
}

bool testimony::is_confirmed(time_point now) const {
  return std::ranges::any_of(confirmed_, [&](const confirmation& x) {
    return now - x.at <= counts_for && (x.by.is_ours || x.by.sender != tells_);
  });
}

bool testimony::is_denied_for_all() const {
  assert(denials_ >= 0 && denials_ <= looks_in_a_row);
  assert(denied_.size() <= most_observers);
  if (denials_ >= looks_in_a_row)
    return true;
  const auto is_other = [&](const denial& x) {
    return x.counts && x.by.sender != tells_;
  };
  const auto first = std::ranges::find_if(denied_, is_other);
  return first != denied_.end()
         && std::ranges::any_of(denied_, [&](const denial& x) {
              return is_other(x) && x.by.sender != first->by.sender;
            });
}

bool testimony::is_denied_by(station_id who) const {
  return std::ranges::any_of(
      denied_, [&](const denial& x) { return x.counts && x.by.number == who; });
}

} // namespace sofof::planners
