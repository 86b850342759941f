// Claiming, hearing, and when a claim binds.
#include "planners/crossing/claim_book.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::planners {

namespace {

bool are_same(const claimed_drive& a, const claimed_drive& b) {
  return a.from == b.from && a.step == b.step
         && std::ranges::equal(a.bodies, b.bodies, {}, &oriented_box::centre,
                               &oriented_box::centre);
}

} // namespace

bool claim_book::claim(time_point now, const claimed_drive& drive,
                       std::span<const station_id> needed) {
  assert(!drive.empty() && drive.step > duration{});
  pass_time(now);
  needed_.assign(needed.begin(), needed.end());
  if (own_ && are_same(*own_, drive))
    return true;
  if (is_closed(drive))
    return false;
  own_ = drive;
  binds_ = false;
  claimed_at_ = now;
  bind_if_all_consent(now);
  assert(is() != state::free);
  return true;
}

void claim_book::on_report(time_point now, const crossing_claim& told,
                           bool matters) {
  assert(!told.drive || told.drive->step > duration{});
  if (told.who == me_ || told.generated > now + 2 * rules_.clock_error)
    return; // an echo, or of a clock that is wrong
  auto x = std::ranges::find(others_, told.who,
                             [](const other& o) { return o.told.who; });
  if (x == others_.end())
    x = others_.insert(others_.end(), other{told, matters});
  else if (told.generated > x->told.generated)
    *x = {told, matters};
  else
    return; // an older one, or the same again
  assert(x->told.who == told.who);
  if (own_ && !binds_ && told.drive && !is_apart(*own_, *told.drive))
    give_up();
  bind_if_all_consent(now);
}

void claim_book::pass_time(time_point now) {
  assert(rules_.clock_error >= duration{} && rules_.memory > duration{});
  if (own_ && (binds_ ? own_->to() < now : now - claimed_at_ > rules_.patience))
    give_up();
  assert(!binds_ || own_);
  // What was claimed by who has fallen silent stays so until it is over.
  std::erase_if(others_, [&](const other& x) {
    return now - x.told.generated > rules_.memory
           && (!x.told.drive
               || x.told.drive->to() + 2 * rules_.clock_error < now);
  });
}

void claim_book::give_up() {
  own_.reset();
  binds_ = false;
}

/// Drives are told by clocks that differ.
bool claim_book::is_apart(const claimed_drive& a,
                          const claimed_drive& b) const {
  return !overlap(a, b, rules_.apart + 2 * rules_.clock_error);
}

bool claim_book::is_closed(const claimed_drive& drive) const {
  return std::ranges::any_of(others_, [&](const other& x) {
    return x.told.drive && !is_apart(drive, *x.told.drive);
  });
}

/// @returns whether a message generated after the claim is there; if it had
/// claimed what overlaps, there would be no claim any more.
bool claim_book::has_consented(station_id who) const {
  return who == me_ || std::ranges::any_of(others_, [&](const other& x) {
           return x.told.who == who
                  && x.told.generated > claimed_at_ + 2 * rules_.clock_error;
         });
}

void claim_book::bind_if_all_consent(time_point now) {
  if (!own_ || binds_)
    return;
  assert(now >= claimed_at_);
  const auto is_silent = [&](const other& x) {
    return !x.matters || now - x.told.generated > rules_.memory
           || has_consented(x.told.who);
  };
  if (!std::ranges::all_of(needed_,
                           [&](station_id x) { return has_consented(x); })
      || !std::ranges::all_of(others_, is_silent))
    return;
  assert(!is_closed(*own_));
  binds_ = true;
}

} // namespace sofof::planners
