// Asking, hearing, and when a window binds.
#include "planners/crossing/claim_book.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::planners {

bool claim_book::ask(time_point now, std::span<const area_window> windows,
                     std::span<const station_id> needed) {
  assert(!windows.empty());
  assert(std::ranges::all_of(
      windows, [](const area_window& w) { return w.from < w.to; }));
  pass_time(now);
  needed_.assign(needed.begin(), needed.end());
  if (std::ranges::equal(windows, binding_)) {
    asked_.clear();
    return true;
  }
  if (std::ranges::equal(windows, asked_))
    return true;
  if (is_closed(windows))
    return false;
  asked_.assign(windows.begin(), windows.end());
  asked_at_ = now;
  bind_if_all_consent(now);
  return true;
}

void claim_book::hear(time_point now, const area_claims& told, bool meets) {
  if (told.who == me_ || told.generated > now + 2 * rules_.clock_error)
    return; // an echo, or of a clock that is wrong
  auto* x = find(told.who);
  if (!x) {
    x = &others_.emplace_back();
    x->who = told.who;
  } else if (told.generated <= x->generated) {
    return; // an older one, or the same again
  }
  x->generated = told.generated;
  x->meets = meets;
  x->windows = told.windows;
  assert(find(told.who) == x);
  if (is_closed(asked_))
    asked_.clear();
  bind_if_all_consent(now);
}

void claim_book::pass_time(time_point now) {
  if (now - asked_at_ > rules_.patience)
    asked_.clear();
  // Of who has fallen silent windows stay closed until they are over.
  std::erase_if(others_, [&](const other& x) {
    return now - x.generated > rules_.memory
           && std::ranges::all_of(x.windows, [&](const area_window& w) {
                return w.to + 2 * rules_.clock_error < now;
              });
  });
  assert(rules_.clock_error >= duration{} && rules_.memory > duration{});
}

void claim_book::leave(std::uint32_t area) {
  for (auto* windows : {&binding_, &asked_})
    std::erase_if(*windows,
                  [area](const area_window& w) { return w.area == area; });
}

void claim_book::give_up() {
  binding_.clear();
  asked_.clear();
}

area_claims claim_book::tell(time_point now) const {
  area_claims all{me_, now, binding_};
  for (const auto& w : asked_)
    if (std::ranges::find(binding_, w) == binding_.end())
      all.windows.push_back(w);
  assert(all.windows.size() <= binding_.size() + asked_.size());
  return all;
}

bool claim_book::is_closed(const area_window& window) const {
  return is_closed(std::span{&window, 1});
}

/// Windows are told by clocks that differ.
bool claim_book::is_closed(std::span<const area_window> windows) const {
  return std::ranges::any_of(others_, [&](const other& x) {
    return std::ranges::any_of(x.windows, [&](const area_window& theirs) {
      return std::ranges::any_of(windows, [&](const area_window& own) {
        return overlap(own, theirs, 2 * rules_.clock_error);
      });
    });
  });
}

claim_book::other* claim_book::find(station_id who) {
  const auto found = std::ranges::find(others_, who, &other::who);
  return found == others_.end() ? nullptr : &*found;
}

/// @returns whether a message generated after the windows were asked for is
/// there; if it claimed them, they would not be asked for any more.
bool claim_book::has_consented(station_id who) const {
  const auto found = std::ranges::find(others_, who, &other::who);
  return found != others_.end()
         && found->generated > asked_at_ + 2 * rules_.clock_error;
}

void claim_book::bind_if_all_consent(time_point now) {
  if (asked_.empty())
    return;
  assert(now >= asked_at_);
  const auto needed = [&](station_id who) {
    return who == me_ || has_consented(who);
  };
  const auto heard = [&](const other& x) {
    return !x.meets || now - x.generated > rules_.memory
           || has_consented(x.who);
  };
  if (!std::ranges::all_of(needed_, needed)
      || !std::ranges::all_of(others_, heard))
    return;
  assert(!is_closed(asked_));
  binding_ = asked_;
  asked_.clear();
}

} // namespace sofof::planners
