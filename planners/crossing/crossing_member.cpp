// Advice, claims, and what comes of them.
#include "planners/crossing/crossing_member.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {
namespace {

using namespace std::chrono_literals;

/// A claim is a body every so often, and begins so far before the line.
constexpr duration claimed_every = 200ms;
constexpr double claims_before_line_m = 1;

/// Who has left the crossing in time but for this has kept its claim.
constexpr double left_within_m = 5;

/// A drive that leaves the crossing so much later or sooner is not kept.
constexpr double leaves_late_s = 0.7;

/// How a car sets off, ...
constexpr double gets_going_mps2 = 1.25;

/// ... and stops before a line.
constexpr double member_stops_mps2 = 2, member_decides_s = 0.5,
                 member_spare_m = 1;

/// Between the lines of two that come to one crossing.
constexpr double crossing_size_m = 20;

double stopping_m(double speed_mps) {
  return speed_mps * (member_decides_s + speed_mps / (2 * member_stops_mps2))
         + member_spare_m;
}

/// @returns how fast a plan begins; nullopt if it does not tell.
std::optional<double> first_speed_mps(const claimed_drive& plan) {
  if (plan.bodies.size() < 2)
    return std::nullopt;
  assert(plan.step > duration{});
  return distance_m(plan.bodies[0].centre, plan.bodies[1].centre)
         / to_seconds(plan.step);
}

/// @returns when a drive is at a place; nullopt if it does not come there.
std::optional<time_point> time_at(const world::trajectory& drive, double s_m) {
  assert(std::isfinite(s_m));
  const auto& all = drive.points;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (all[k].s_m >= s_m) {
      if (k == 0)
        return drive.start + from_seconds(all[0].t_s);
      const auto piece_m = all[k].s_m - all[k - 1].s_m;
      const auto share = (s_m - all[k - 1].s_m) / piece_m;
      return drive.start
             + from_seconds(std::lerp(all[k - 1].t_s, all[k].t_s, share));
    }
  return std::nullopt;
}

} // namespace

crossing_member::crossing_member(station_id me,
                                 const world::vehicle_params& car, rules r)
    : me_{me}, car_{car}, rules_{r}, book_{me, r.claims} {}

void crossing_member::advise(time_point now, const world::trajectory& drive) {
  assert(drive.is_sound());
  advised_ = {drive, now + rules_.advice_holds};
}

bool crossing_member::can_stop() const {
  return own_.line_m - own_.s_m - car_.front_m > stopping_m(own_.speed_mps);
}

std::optional<time_point>
crossing_member::enters(const world::trajectory& drive) const {
  return time_at(drive, own_.line_m - car_.front_m);
}

/// @returns whether it comes to the crossing, and leaves it, when the drive
/// does, as far as the plan in use tells.
bool crossing_member::is_kept(time_point now,
                              const world::trajectory& drive) const {
  assert(own_.speed_mps >= 0 && std::isfinite(own_.line_m));
  assert(!drive.empty());
  const auto line_m = own_.line_m - car_.front_m;
  if (own_.s_m > line_m)
    return true;
  const auto clear_m = own_.clear_m + car_.rear_m;
  const auto left = time_at(drive, clear_m);
  const auto leaves = own_.plan ? time_at(*own_.plan, clear_m) : std::nullopt;
  if (left && leaves && std::abs(to_seconds(*leaves - *left)) > leaves_late_s)
    return false;
  const auto then = time_at(drive, line_m);
  const auto comes = own_.plan ? time_at(*own_.plan, line_m) : std::nullopt;
  if (!then)
    return false;
  if (!comes) {
    const auto v = own_.speed_mps, way_m = line_m - own_.s_m;
    const auto soonest_s =
        (std::sqrt(v * v + 2 * gets_going_mps2 * way_m) - v) / gets_going_mps2;
    return now + from_seconds(soonest_s) < *then + from_seconds(rules_.late_s);
  }
  return std::abs(to_seconds(*comes - *then)) < rules_.late_s;
}

/// @returns whether it is so far behind a drive that others, had it claimed
/// that, would not count on it.
bool crossing_member::is_behind(time_point now,
                                const world::trajectory& drive) const {
  assert(!drive.empty() && own_.speed_mps >= 0);
  const auto behind_m = drive.at(now).s_m - own_.s_m;
  return behind_m > most_behind_m(own_.speed_mps);
}

/// @returns whether the car is on the crossing, and farther than its drive says
/// by so much that others would not find it where the drive is.
bool crossing_member::is_before(time_point now,
                                const world::trajectory& drive) const {
  assert(!drive.empty() && own_.speed_mps >= 0);
  const auto before_m = own_.s_m - drive.at(now).s_m;
  return own_.s_m + car_.front_m > own_.line_m
         && before_m > most_behind_m(own_.speed_mps);
}

claimed_drive crossing_member::claim_of(const world::trajectory& drive) const {
  assert(!drive.empty());
  assert(own_.clear_m >= own_.line_m);
  claimed_drive claim{{}, claimed_every, {}};
  const auto from =
      time_at(drive, own_.line_m - car_.front_m - claims_before_line_m);
  const auto to = time_at(drive, own_.clear_m + car_.rear_m);
  if (!from)
    return claim;
  claim.from = *from;
  const auto middle_m = (car_.front_m - car_.rear_m) / 2;
  const auto end = to.value_or(drive.end());
  for (auto t = *from; t <= end + claimed_every; t += claimed_every) {
    const auto p = drive.at(t);
    const point ahead{std::cos(p.heading_rad), std::sin(p.heading_rad)};
    claim.bodies.push_back({p.at + middle_m * ahead, p.heading_rad,
                            car_.front_m + car_.rear_m, car_.width_m});
  }
  return claim;
}

/// @returns whether one that is there, with this plan, may claim what the own
/// claim overlaps.
bool crossing_member::is_near(const claimed_drive& plan, point from) const {
  assert(own_.speed_mps >= 0);
  const auto claims_from_m = [this](double speed_mps) {
    return std::max(speed_mps * to_seconds(rules_.claims_before),
                    stopping_m(speed_mps));
  };
  const auto other_mps = first_speed_mps(plan).value_or(own_.speed_mps);
  const auto both_m = claims_from_m(own_.speed_mps) + claims_from_m(other_mps)
                      + crossing_size_m;
  return distance_m(from, own_.at) < std::max(rules_.near_m, both_m);
}

void crossing_member::on_report(time_point now, const crossing_claim& told,
                                const claimed_drive& plan, point from) {
  if (told.who == me_)
    return;
  assert(std::isfinite(from.x_m) && std::isfinite(from.y_m));
  book_.on_report(now, told, is_near(plan, from));
  follow_claim(now);
  auto x = std::ranges::lower_bound(told_, told.who, {},
                                    [](const heard& h) { return h.is.who; });
  if (x == told_.end() || x->is.who != told.who)
    x = told_.insert(x, heard{});
  else if (told.generated < x->at)
    return;
  assert(x->is.who == told.who || x->is.who == station_id{0});
  *x = {{told.who, plan, told.drive.has_value(), from}, told.generated};
}

void crossing_member::move(time_point now, const place& own) {
  assert(std::isfinite(own.s_m) && own.speed_mps >= 0);
  assert(own.clear_m >= own.line_m);
  own_ = own;
  book_.pass_time(now);
  std::erase_if(
      told_, [&](const heard& x) { return now - x.at > rules_.claims.memory; });
  if (advised_ && now > advised_->until)
    advised_.reset();
  // Until a claim binds its owner waits at the line, so it can stop.
  const auto may_stop = can_stop() || book_.is() == claim_book::state::claimed;
  if (book_.is() != claim_book::state::free
      && (is_behind(now, claimed_) || is_before(now, claimed_)
          || (may_stop && !is_kept(now, claimed_))))
    book_.give_up();
  follow_claim(now);
  if (book_.is() == claim_book::state::free && advised_)
    claim(now, advised_->drive);
  own_.plan = nullptr; // it is the caller's
}

void crossing_member::claim(time_point now, const world::trajectory& drive) {
  assert(book_.is() == claim_book::state::free);
  assert(!drive.empty());
  const auto at = enters(drive);
  const auto has_left =
      own_.s_m - car_.rear_m > own_.clear_m
      || drive.points.front().s_m - car_.rear_m > own_.clear_m;
  if (!at || has_left || done_m_ == own_.line_m || !is_kept(now, drive)
      || is_behind(now, drive) || is_before(now, drive)
      || (*at - now > rules_.claims_before && can_stop()))
    return;
  const auto leaves = time_at(drive, own_.clear_m + car_.rear_m);
  if (!leaves || *leaves - now > rules_.told)
    return; // others would hear a part of it
  const auto claim = claim_of(drive);
  if (claim.empty() || !book_.claim(now, claim, {}))
    return;
  assert(book_.is() != claim_book::state::free);
  claimed_ = drive;
  claimed_line_m_ = own_.line_m;
  claimed_clear_m_ = own_.clear_m;
  present_ = {now, std::nullopt, *at, *leaves, false};
  follow_claim(now);
}

/// Remembers when a claim is bound, and how it ends.
void crossing_member::follow_claim(time_point now) {
  if (!present_)
    return;
  assert(present_->claimed <= now);
  assert(!present_->bound || *present_->bound <= now);
  const auto is = book_.is();
  if (is == claim_book::state::bound && !present_->bound)
    present_->bound = now;
  if (is != claim_book::state::free)
    return;
  present_->was_kept = present_->bound && now >= present_->leaves
                       && own_.s_m > claimed_clear_m_ - left_within_m;
  if (present_->was_kept)
    done_m_ = claimed_line_m_;
  past_ = std::exchange(present_, {});
}

const world::trajectory* crossing_member::drive() const {
  return book_.is() != claim_book::state::free ? &claimed_
         : advised_                            ? &advised_->drive
                                               : nullptr;
}

void crossing_member::look(time_point, crossing_view& out) const {
  const auto* keeps = drive();
  out.drive = keeps ? *keeps : world::trajectory{};
  out.line_m = own_.line_m;
  out.binds = book_.is() == claim_book::state::bound;
  out.told.clear();
  for (const auto& x : told_)
    out.told.push_back(x.is);
}

} // namespace sofof::planners
