// Whose turn it is at the crossings.
#include "world/traffic/right_of_way.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <limits>

namespace sofof::world {

namespace {

using namespace std::chrono_literals;

constexpr auto never = std::numeric_limits<double>::infinity();

/// Between bumpers at rest, m: more than planners keep (3 m).
constexpr auto rest_gap_m = 3.5;

/// Who waits may stand this far before where it must stop, m.
constexpr auto line_slack_m = 1.0;

/// Who stands although there is so much room ahead does so on its own.
constexpr auto idle_gap_m = 6.0;
constexpr auto standing_mps = 0.1;

/// Requests come early enough to brake like this, after hesitating.
constexpr auto comfort_decel_mps2 = 1.5;
constexpr auto hesitation_s = 1.0;
constexpr auto asking_margin_m = 10.0;

/// Who gives way is clear of a zone this long before the other arrives, s.
constexpr auto time_gap_s = 2.0;

/// How drivers pull away, m/s².
constexpr auto start_accel_mps2 = 1.2;

/// Who has waited for longer goes before all ranks.
constexpr auto patience = 20s;
constexpr auto rank_of_the_impatient = -1;

/// Who stands for so long before what it was granted does not need it now.
constexpr auto longest_unused = 5s;

/// A request looks at no more road users than this.
constexpr auto max_looks = 200;

double asking_distance_m(double speed_mps) {
  return asking_margin_m + hesitation_s * speed_mps
         + speed_mps * speed_mps / (2 * comfort_decel_mps2);
}

/// @returns how long a distance takes when pulling away from a speed to a top
/// speed, not below the first, s.
double drive_s(double distance_m, double speed_mps, double top_mps) {
  constexpr auto a = start_accel_mps2;
  const auto run_up_m = (top_mps * top_mps - speed_mps * speed_mps) / (2 * a);
  if (distance_m <= 0)
    return 0;
  if (distance_m < run_up_m)
    return (std::sqrt(speed_mps * speed_mps + 2 * a * distance_m) - speed_mps)
           / a;
  return (top_mps - speed_mps) / a + (distance_m - run_up_m) / top_mps;
}

/// @returns the gap at rest to leave behind somebody who is `now_m` away: a
/// queue that stands closer moves on as close.
double gap_m(double now_m) {
  return now_m > 0 ? std::min(now_m, rest_gap_m) : rest_gap_m;
}

/// @returns when a zone is clear of somebody who has to give way there, s.
double clears_after_s(const road_user_state& d, const zone& z) {
  const auto speed_mps = std::min(d.known.speed_mps, z.pace_mps);
  return drive_s(z.to_m - d.rear_m(), speed_mps, z.pace_mps);
}

/// @returns when somebody with priority reaches a zone, s.
double arrives_after_s(const road_user_state& d, const zone& z) {
  const auto distance_m = z.from_m - d.front_m();
  const auto speed_mps = d.known.speed_mps;
  if (d.asks_since)
    return drive_s(distance_m, speed_mps, std::max(speed_mps, z.pace_mps));
  return speed_mps > 0 ? distance_m / speed_mps : never;
}

bool owns(const road_user_state& d, const zone& z) {
  return z.from_m < d.granted_to_m;
}

/// @returns whether somebody who asks cannot go, whoever gives way to it.
bool is_stuck(const road_user_state& d) {
  return d.last == road_user_state::answer::full
         || d.last == road_user_state::answer::wait;
}

} // namespace

void right_of_way::decide(std::span<road_user_state> drivers,
                          const lane_order& order, time_point now) {
  drivers_ = drivers;
  order_ = &order;
  now_ = now;
  asking_.clear();
  for (auto& users : users_)
    users.clear();
  std::ranges::fill(on_roundabout_, 0);
  for (std::uint32_t who = 0; who < drivers_.size(); ++who)
    enter(who);
  std::ranges::sort(asking_, [&](auto a, auto b) {
    return goes_before(drivers_[a], drivers_[a].rank, drivers_[b],
                       drivers_[b].rank);
  });
  kept_a_place_.assign(on_roundabout_.size(), false);
  for (const auto who : asking_)
    if (drivers_[who].asks_since) {
      drivers_[who].last = ask(who);
      keep_a_place(who);
    }
}

/// Keeps a place on a roundabout for the first who has waited long and finds
/// its zones taken: else others take each place that comes free before.
void right_of_way::keep_a_place(std::uint32_t who) {
  const auto& d = drivers_[who];
  const auto is_taken = d.last == road_user_state::answer::held
                        || d.last == road_user_state::answer::wait;
  if (!is_taken || !is_impatient(d))
    return;
  assert(party_.front().who == who); // of its request, just now
  const auto to_m = party_.front().clear_m + d.length_m();
  const auto ring = roundabout_between(d, d.line_m, to_m);
  if (ring == roundabouts_.count() || ring == roundabout_of(d)
      || kept_a_place_[ring])
    return;
  kept_a_place_[ring] = true;
  ++on_roundabout_[ring];
}

/// Enters a driver at all zones from its rear to as far as it sees.
void right_of_way::enter(std::uint32_t who) {
  auto& d = drivers_[who];
  d.granted_to_m = std::max(d.granted_to_m, d.front_m());
  d.way->for_zones(d.rear_m() - d.way->longest_zone_m(), d.front_m() + sight_m,
                   [&](const zone& z) {
                     if (z.to_m > d.rear_m())
                       users_[z.side].push_back({who, z});
                     return true;
                   });
  find_line(d);
  give_back(who);
  const auto ring = roundabout_of(d);
  if (ring < on_roundabout_.size())
    ++on_roundabout_[ring];
  const auto way_m = d.line_m - stop_margin_m - d.front_m();
  if (way_m > asking_distance_m(d.known.speed_mps)) {
    d.asks_since.reset();
    d.last = road_user_state::answer::none;
    return;
  }
  if (!d.asks_since)
    d.asks_since = now_;
  asking_.push_back(who);
}

/// Somebody may see what is in its way behind the crossing, as nobody does
/// here.
void right_of_way::give_back(std::uint32_t who) {
  auto& d = drivers_[who];
  if (d.known.speed_mps > standing_mps)
    d.stands_since.reset();
  else if (!d.stands_since)
    d.stands_since = now_;
  if (!d.stands_since || now_ - *d.stands_since < longest_unused
      || !is_idle(who))
    return;
  auto is_on_a_zone = false;
  d.way->for_zones(d.rear_m() - d.way->longest_zone_m(), d.front_m(),
                   [&](const zone& z) {
                     is_on_a_zone = is_on_a_zone || z.to_m > d.rear_m();
                     return !is_on_a_zone;
                   });
  if (is_on_a_zone)
    return;
  d.granted_to_m = d.front_m();
  find_line(d);
}

/// Finds the first zone that has not been granted.
void right_of_way::find_line(road_user_state& d) const {
  d.line_m = never;
  d.way->for_zones(d.granted_to_m, d.front_m() + sight_m, [&](const zone& z) {
    d.line_m = z.from_m;
    d.rank = z.rank;
    return false;
  });
}

bool right_of_way::is_impatient(const road_user_state& d) const {
  return d.asks_since && now_ - *d.asks_since > patience;
}

bool right_of_way::goes_before(const road_user_state& a, int rank_a,
                               const road_user_state& b, int rank_b) const {
  if (is_impatient(a))
    rank_a = rank_of_the_impatient;
  if (is_impatient(b))
    rank_b = rank_of_the_impatient;
  if (rank_a != rank_b)
    return rank_a < rank_b;
  if (!a.asks_since || !b.asks_since)
    return a.asks_since.has_value();
  return std::pair{*a.asks_since, a.known.station}
         < std::pair{*b.asks_since, b.known.station};
}

road_user_state::answer right_of_way::ask(std::uint32_t who) {
  party_.clear();
  wanted_.clear();
  looks_ = 0;
  if (!join(who))
    return road_user_state::answer::full;
  if (is_held(party_.front()))
    return road_user_state::answer::held;
  if (gives_way(party_.front()))
    return road_user_state::answer::wait;
  if (!std::ranges::all_of(
          party_, [this](const request& r) { return may_be_let_on(r); }))
    return road_user_state::answer::full;
  for (const auto& r : party_) {
    auto& d = drivers_[r.who];
    const auto ring = roundabout_between(d, d.line_m, r.clear_m + d.length_m());
    if (ring < on_roundabout_.size() && ring != roundabout_of(d))
      ++on_roundabout_[ring];
    d.granted_to_m = r.clear_m;
    d.asks_since.reset();
    d.stands_since.reset();
    d.last = road_user_state::answer::go;
    find_line(d);
  }
  return road_user_state::answer::go;
}

/// @returns whether a driver, and all those who must go for it to find room,
/// could go together.
bool right_of_way::join(std::uint32_t who) {
  const auto& d = drivers_[who];
  request r{who, wanted_.size(), wanted_.size(), d.line_m};
  const auto lap_m = d.way->on()->length_m();
  d.way->for_zones(d.line_m, d.line_m + lap_m, [&](const zone& z) {
    if (z.from_m > r.clear_m + d.length_m() + rest_gap_m)
      return false;
    wanted_.push_back(z);
    r.clear_m = std::max(r.clear_m, z.to_m);
    return true;
  });
  r.end_zone = wanted_.size();
  const auto is_first = party_.empty();
  if (!is_first
      && (is_held(r) || std::ranges::any_of(party_, [&](const request& other) {
            return excludes(r, other);
          })))
    return false;
  party_.push_back(r);
  return finds_room(who, std::min(r.clear_m + d.length_m(), d.way->end_m()));
}

/// @returns the first roundabout on a driver's way; their count for none.
std::size_t right_of_way::roundabout_between(const road_user_state& d,
                                             double from_m, double to_m) const {
  const auto last = d.way->leg_at(to_m);
  for (auto i = d.way->leg_at(from_m); i <= last; ++i)
    if (const auto ring = roundabouts_.of(d.way->lane(i));
        ring < roundabouts_.count())
      return ring;
  return roundabouts_.count();
}

/// @returns the roundabout that a driver is on, or has been let on to.
std::size_t right_of_way::roundabout_of(const road_user_state& d) const {
  const auto is_let_on = d.granted_to_m > d.front_m();
  return roundabout_between(
      d, d.rear_m(), is_let_on ? d.granted_to_m + d.length_m() : d.front_m());
}

/// @returns whether the roundabout that a driver comes to, if any, has room for
/// one more.
bool right_of_way::may_be_let_on(const request& r) const {
  const auto& d = drivers_[r.who];
  const auto ring = roundabout_between(d, d.line_m, r.clear_m + d.length_m());
  return ring == roundabouts_.count() || ring == roundabout_of(d)
         || on_roundabout_[ring] < roundabouts_.most(ring);
}

/// @returns whether a driver's front could get there if nobody but the party
/// were ever granted anything again.
bool right_of_way::can_reach(std::uint32_t who, double front_m) {
  const auto& d = drivers_[who];
  if (d.front_m() >= front_m)
    return true;
  if (is_idle(who))
    return false;
  if (front_m <= d.line_m - stop_margin_m - line_slack_m)
    return finds_room(who, front_m);
  if (!find_request(who)) {
    const auto may_join =
        d.asks_since && is_impatient(drivers_[party_.front().who]);
    if (!may_join || !join(who))
      return false;
  }
  return front_m <= find_request(who)->clear_m + d.length_m();
}

/// @returns whether a driver stands without need: who knows for how long.
bool right_of_way::is_idle(std::uint32_t who) const {
  const auto& d = drivers_[who];
  if (d.known.speed_mps > standing_mps || d.line_m - d.front_m() < idle_gap_m)
    return false;
  const auto seen = order_->ahead_of(who);
  return !seen || seen->rear_m - d.front_m() > idle_gap_m;
}

const right_of_way::request*
right_of_way::find_request(std::uint32_t who) const {
  const auto r = std::ranges::find(party_, who, &request::who);
  return r == party_.end() ? nullptr : &*r;
}

/// @returns whether those ahead of a driver would let its front get there.
bool right_of_way::finds_room(std::uint32_t who, double front_m) {
  for (auto seen = order_->ahead_of(who); seen;
       seen = order_->beyond(who, *seen)) {
    const auto& other = drivers_[seen->who];
    const auto need_m = front_m + gap_m(seen->rear_m - drivers_[who].front_m());
    if (seen->rear_m >= need_m)
      return true;
    if (++looks_ > max_looks)
      return false;
    const auto rear_m = order_->shared_to_m(who, *seen, need_m);
    const auto shift_m = other.known.s_m - seen->axle_m;
    if (seen->rear_m < rear_m
        && !can_reach(seen->who, rear_m + shift_m + other.length_m()))
      return false;
    if (rear_m == need_m)
      return true; // the others are ahead of that one
  }
  return true;
}

bool right_of_way::is_held(const request& r) const {
  return std::ranges::any_of(zones(r), [&](const zone& z) {
    return std::ranges::any_of(users_[z.other_side()], [&](const user& u) {
      return u.who != r.who && owns(drivers_[u.who], u.on);
    });
  });
}

bool right_of_way::excludes(const request& a, const request& b) const {
  return std::ranges::any_of(zones(a), [&](const zone& z) {
    const auto sides = zones(b);
    return std::ranges::find(sides, z.other_side(), &zone::side) != sides.end();
  });
}

bool right_of_way::gives_way(const request& r) const {
  const auto& d = drivers_[r.who];
  return std::ranges::any_of(zones(r), [&](const zone& z) {
    const auto late_s = clears_after_s(d, z) + time_gap_s;
    return std::ranges::any_of(users_[z.other_side()], [&](const user& u) {
      const auto& other = drivers_[u.who];
      return u.who != r.who && !is_stuck(other)
             && goes_before(other, u.on.rank, d, z.rank)
             && arrives_after_s(other, u.on) < late_s;
    });
  });
}

} // namespace sofof::world
