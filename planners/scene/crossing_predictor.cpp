// Who crosses the own way, when, and who goes first.
#include "planners/scene/crossing_predictor.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>

namespace sofof::planners {

namespace {

/// Who would have to brake harder than this to give way does not, m/s²; nor who
/// would have to brake so hard and has not begun to.
constexpr auto yielding_decel_mps2 = 6.0, begins_by_mps2 = 3.0;

double forward_mps(const track& x) {
  return std::max(0.0, x.speed_mps());
}

/// Ways at a smaller angle than 30° to each other, either way, come from
/// neither side.
constexpr auto across_sine = 0.5;

/// Ways at a smaller angle than 30° against each other come towards each other.
constexpr auto towards_cosine = 0.866;

/// Who turns left by more than this crosses who comes towards it.
constexpr auto turning_rad = 0.5;

/// Nobody turns before another who comes to the place sooner after it than
/// this, s; who would have to give way brakes at least so.
constexpr auto close_s = 1.5, slows_down_mps2 = 1.0;
/// Who is slower than this may as well be moving up to its line, m/s.
constexpr auto creeps_mps = 1.0;
/// A car that accelerates by more than this, m/s², and comes within so many
/// seconds, has set off.
constexpr auto pulls_away_mps2 = 0.3, comes_soon_s = 5.0;

/// Who comes later than this to a zone that a car is on already can brake, s.
constexpr auto soon_s = 2.0;

/// A car slower than this, m/s, that comes within so many seconds may come to
/// rest among crossings.
constexpr auto hesitant_mps = 3.0, hesitates_s = 5.0;

/// What a car brakes with at most when it has begun in time, m/s².
constexpr auto easy_decel_mps2 = 2.0;

/// Who stands before a zone for longer than this is not waited for any more.
constexpr duration patience = std::chrono::seconds{4};
constexpr duration more_patience = std::chrono::milliseconds{500};
/// And so much longer, for each rank that it goes before the own car: whoever
/// held it up may just have gone.
constexpr duration patience_by_rank = std::chrono::seconds{4};
constexpr std::uint32_t different_patiences = 8;

duration patience_of(const std::optional<station_id>& who) {
  constexpr auto spread = 2654435761U; // of neighbouring numbers (Knuth)
  const auto mixed = who ? who->value() * spread >> 16 : 0;
  return patience + (mixed % different_patiences) * more_patience;
}

/// @returns the braking that stops a body after so long a way, if it begins as
/// soon as its driver has seen why; infinite: none does.
double decel_before(double way_m, double speed_mps) {
  constexpr auto reaction_s = 1.0;
  const auto left_m = way_m - reaction_s * speed_mps;
  return left_m > 0 ? speed_mps * speed_mps / (2 * left_m)
                    : std::numeric_limits<double>::infinity();
}

} // namespace

crossing_predictor::crossing_predictor(known_way_ptr way, double corridor_m,
                                       double foresight_s)
    : way_{std::move(way)}, corridor_m_{corridor_m}, foresight_s_{foresight_s} {
  assert(corridor_m_ > 0 && foresight_s_ >= 0);
}

void crossing_predictor::look_ahead(double rear_m, double front_m, double to_m,
                                    std::vector<way_stretch>& keep_free) {
  assert(rear_m < front_m && front_m < to_m);
  find_zones(rear_m, to_m);
  join_zones(rear_m, front_m, keep_free);
}

double crossing_predictor::patience_s(const std::optional<station_id>& who,
                                      double front_m) const {
  constexpr auto more_s = 11.0, by_rank_s = 8.0;
  auto rank = 0;
  assert(std::isfinite(front_m));
  for (const auto& own : zones_)
    if (own.on.to_m > front_m
        && own.on.from_m < front_m + lane_network::at_line_m)
      rank = std::max(rank, own.on.rank);
  assert(rank >= 0);
  return to_seconds(patience_of(who)) + more_s + by_rank_s * rank;
}

void crossing_predictor::judge(const crossing_viewer& me,
                               std::span<other_body> others,
                               std::span<const way_stretch> keep_free,
                               std::vector<crossing_user>& found,
                               std::vector<double>& yields) {
  assert(me.rear_m < me.front_m);
  for (const auto& own : zones_)
    if (way_->lanes->rank(own.on.other_side()) < own.on.rank)
      yields.push_back(own.on.from_m);
  foresee(others);
  for (const auto& own : zones_)
    for (const auto& [who, when] : foreseen_) {
      auto& [x, is_crossing, cuts_in, has_claimed, takes_part] = others[who];
      if (when.side != own.on.other_side() || !std::isfinite(when.leave_s)
          || (when.way_m == 0 && drives_along(x, own.on))
          || (when.is_past && gap_m(x, own.on) > 0))
        continue;
      if (has_claimed
          || (takes_part && (when.way_m > 0 || stays_off(x, own.on)))) {
        is_crossing = true;
        continue;
      }
      const auto first = !gives_way(me, x, when, own);
      const auto hesitates =
          first && forward_mps(x) < hesitant_mps && when.enter_s < hesitates_s;
      found.push_back(
          {hesitates ? line_before(me, own, keep_free) : own.on.from_m,
           own.on.to_m, when.enter_s,
           first ? leaves_s({who, when}) : when.leave_s, first,
           decel_before(when.way_m, forward_mps(x)), x.id});
      cuts_in = cuts_in
                || (own.on.from_m < me.front_m && found.back().goes_first
                    && !when.sets_off && when.enter_s < soon_s);
      is_crossing =
          is_crossing || (own.on.from_m >= me.front_m && !when.sets_off);
    }
  std::ranges::sort(found, {}, [](const crossing_user& x) {
    return std::tuple{x.from_m, x.to_m, x.body};
  });
  assert(std::ranges::is_sorted(yields));
}

/// @returns when a body leaves a zone; later than it would at its speed, if it
/// has to wait before, or there, for a third one.
double crossing_predictor::leaves_s(const foreseen& x) const {
  auto late_s = 0.0;
  assert(x.when.enter_s <= x.when.leave_s);
  for (const auto& [who, own] : foreseen_) {
    if (who != x.who || own.way_m <= 0 || own.enter_s > x.when.leave_s)
      continue;
    for (const auto& [third, other] : foreseen_)
      if (third != who && other.side == (own.side ^ 1U) && other.rank < own.rank
          && std::isfinite(other.leave_s) && other.enter_s < own.leave_s
          && other.leave_s > own.enter_s)
        late_s = std::max(late_s, other.leave_s - own.enter_s);
  }
  assert(late_s >= 0);
  return x.when.leave_s + late_s;
}

/// @returns where the crossings begin that a zone is one of, if the vehicle can
/// still stop there with ease; else where the zone begins.
double crossing_predictor::line_before(const crossing_viewer& me,
                                       const own_zone& own,
                                       std::span<const way_stretch> keep_free) {
  const auto stopping_m = me.speed_mps * me.speed_mps / (2 * easy_decel_mps2);
  for (const auto& all : keep_free)
    if (all.from_m <= own.on.from_m && own.on.from_m <= all.to_m
        && me.front_m + stopping_m <= all.from_m)
      return all.from_m;
  return own.on.from_m;
}

/// Zones between which no car fits are one; what begins before a front that is
/// among them is another.
void crossing_predictor::join_zones(double rear_m, double front_m,
                                    std::vector<way_stretch>& keep_free) const {
  const auto car_m = front_m - rear_m;
  assert(car_m > 0);
  for (const auto& [own, middle] : zones_) {
    const auto joins =
        !keep_free.empty() && own.from_m < keep_free.back().to_m + car_m
        && (own.from_m < front_m) == (keep_free.back().from_m < front_m);
    if (joins)
      keep_free.back().to_m = std::max(keep_free.back().to_m, own.to_m);
    else
      keep_free.push_back({own.from_m, own.to_m});
  }
  assert(std::ranges::is_sorted(keep_free, {}, &way_stretch::from_m));
}

bool crossing_predictor::gives_way(const crossing_viewer& me, const track& x,
                                   const conflict_visit& when,
                                   const own_zone& own) const {
  const auto v = forward_mps(x);
  assert(when.way_m >= 0 && when.enter_s <= when.leave_s);
  assert(me.speed_mps >= 0 && own.on.from_m <= own.on.to_m);
  // A zone begins before bodies touch.
  const auto way_m = when.way_m > 0 ? when.way_m : gap_m(x, own.on);
  if (way_m <= 0)
    return false; // it is there
  const auto brakes = x.accel_mps2 < -slows_down_mps2;
  if (me.speed_mps < stands_below_mps && !brakes
      && ((v > creeps_mps && when.enter_s < close_s)
          || (when.rank <= own.on.rank && x.accel_mps2 > pulls_away_mps2
              && v > stands_below_mps && when.enter_s < comes_soon_s)))
    return false; // who stands does not set off before who comes anyway
  if (v * v > 2 * (brakes ? yielding_decel_mps2 : begins_by_mps2) * way_m) {
    // It will be there, unless it goes elsewhere, as who has to give way and
    // does not slow down. That is believed of who comes towards the car, and
    // of everybody by a car that could only brake hard.
    const auto own_way_m = std::max(0.0, own.on.from_m - me.front_m);
    const auto goes_on =
        me.speed_mps * me.speed_mps > 2 * begins_by_mps2 * own_way_m;
    return when.may_turn_off
           && (goes_on || (!brakes && would_turn_across(when, own)))
           && own_way_m < me.speed_mps * (when.enter_s + close_s)
           && has_to_give_way(me, x, when, own);
  }
  const auto waits =
      me.is_impatient
          ? duration::zero()
          : patience_of(me.station)
                + std::max(0, own.on.rank - when.rank) * patience_by_rank;
  if (when.sets_off && x.at - x.moved > waits)
    return true;
  return has_to_give_way(me, x, when, own);
}

/// @returns whether it comes towards the car and only meets it if it turns
/// left.
bool crossing_predictor::would_turn_across(const conflict_visit& when,
                                           const own_zone& own) const {
  const auto theirs = way_->lanes->course_of(when.side);
  const auto ours = way_->lanes->course_of(own.on.side);
  return std::cos(theirs.from_rad - ours.from_rad) < -towards_cosine
         && theirs.turn_rad > turning_rad && ours.turn_rad <= turning_rad;
}

/// @returns whether it has to by right of way.
bool crossing_predictor::has_to_give_way(const crossing_viewer& me,
                                         const track& x,
                                         const conflict_visit& when,
                                         const own_zone& own) const {
  assert(when.side == own.on.other_side() && when.side != own.on.side);
  assert(!me.station || x.station != me.station); // not the own one
  if (when.rank != own.on.rank)
    return when.rank > own.on.rank;
  if (way_->lanes->is_on_roundabout(when.side)
      != way_->lanes->is_on_roundabout(own.on.side))
    return way_->lanes->is_on_roundabout(own.on.side);
  const auto theirs = way_->lanes->course_of(when.side);
  const auto ours = way_->lanes->course_of(own.on.side);
  const auto sine = std::sin(theirs.from_rad - ours.from_rad);
  if (std::abs(sine) > across_sine)
    return sine < 0; // it comes from the left
  const auto turns_left = [](const lane_network::course& c) {
    return c.turn_rad > turning_rad;
  };
  if (turns_left(theirs) != turns_left(ours))
    return turns_left(theirs);
  return me.station && x.station && *me.station < *x.station;
}

void crossing_predictor::find_zones(double from_m, double to_m) {
  assert(way_->legs.longest_zone_m() >= 0);
  zones_.clear();
  way_->legs.for_zones(
      from_m - way_->legs.longest_zone_m(), to_m, [&](const world::zone& z) {
        const auto middle_m = (z.from_m + z.to_m) / 2;
        assert(z.from_m <= z.to_m && z.from_m < to_m);
        if (z.to_m > from_m)
          zones_.push_back({z, way_->route()->path().at(middle_m)});
        return true;
      });
}

/// Finds out when the others reach conflicts, if they may reach the own ones.
void crossing_predictor::foresee(std::span<const other_body> others) {
  foreseen_.clear();
  for (std::size_t who = 0; who < others.size(); ++who) {
    const auto& x = others[who].x;
    const auto within_m =
        std::clamp(foresight_s_ * forward_mps(x), lane_network::at_line_m,
                   lane_network::farthest_m);
    assert(within_m >= 0 && x.length_m > 0);
    const auto gets_there = [&](const own_zone& z) {
      const auto reach_m = within_m + x.length_m + z.on.to_m - z.on.from_m;
      const auto apart = z.middle.at - x.centre();
      return dot(apart, apart) < reach_m * reach_m;
    };
    if (std::ranges::none_of(zones_, gets_there))
      continue;
    arrivals_.clear();
    way_->lanes->foresee(x, within_m, arrivals_);
    for (const auto& when : arrivals_) {
      assert(when.enter_s <= when.leave_s);
      foreseen_.push_back({who, when});
    }
  }
}

/// @returns whether a body on a zone, which begins before bodies touch, can
/// stop where it is off the own way.
bool crossing_predictor::stays_off(const track& x, const world::zone& z) const {
  const auto v = forward_mps(x);
  return v * v < 2 * begins_by_mps2 * gap_m(x, z);
}

/// @returns how far a body's outline is from the way of the own body at a zone;
/// not above 0 where it reaches into it.
double crossing_predictor::gap_m(const track& x, const world::zone& z) const {
  const auto& line = way_->route()->path();
  assert(x.length_m > 0 && z.from_m <= z.to_m);
  const point ahead{std::cos(x.heading_rad), std::sin(x.heading_rad)};
  const point left{-ahead.y_m, ahead.x_m};
  auto nearest_m = std::numeric_limits<double>::infinity();
  auto is_left = false, is_right = false;
  for (const auto along : {-0.5, 0.0, 0.5})
    for (const auto across : {-0.5, 0.5}) {
      const auto p =
          x.centre() + along * x.length_m * ahead + across * x.width_m * left;
      const auto d_m = line.project(p, (z.from_m + z.to_m) / 2,
                                    (z.to_m - z.from_m) / 2 + x.length_m)
                           .d_m;
      nearest_m = std::min(nearest_m, std::abs(d_m));
      (d_m > 0 ? is_left : is_right) = true;
    }
  assert(std::isfinite(nearest_m));
  return is_left && is_right ? 0 : nearest_m - corridor_m_;
}

/// @returns whether a body at a zone drives on the own way already.
bool crossing_predictor::drives_along(const track& x,
                                      const world::zone& z) const {
  const auto& line = way_->route()->path();
  const auto on = line.project(x.centre(), (z.from_m + z.to_m) / 2,
                               (z.to_m - z.from_m) / 2 + x.length_m);
  const auto turned_rad = x.heading_rad - line.at(on.s_m).heading_rad;
  return std::abs(on.d_m) < corridor_m_ && is_along(std::cos(turned_rad));
}

} // namespace sofof::planners
