// What the tracks on the road mean to one vehicle on its route.
#include "planners/scene/scene_interpreter.hpp"

#include "base/thread_room.hpp"
#include "planners/scene/told_scene.hpp"

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

/// Of sums of widths.
constexpr auto rounding_m = 1e-6;
/// A body that was passable stays so with so much less room.
constexpr auto hysteresis_m = 0.1;
/// Where a car cannot stop before a body any more it goes on beside it if so
/// much is left on both sides together.
constexpr auto least_room_to_pass_m = 0.3;
constexpr auto decides_within_s = 0.7; // with what it keeps before the body
constexpr auto stops_mps2 = 2.0;
/// Longer than any conflict of two ways and the car, and what bodies move until
/// their sightings are used.
constexpr auto ample_m = 60.0;
/// So much way a car needs to steer round a body from rest, besides what it
/// keeps to one ahead; and how it brakes if it is to stand there.
constexpr auto pulls_out_m = 5.0, calmly_mps2 = 1.5;
/// From so far behind a body more is seen of the opposite lane.
constexpr auto looks_past_m = 11.0;
/// What has stood for so long is overtaken; and for so long in a row, which
/// may be a queue otherwise, with less than this between.
constexpr duration surely_stands = std::chrono::seconds{5};
constexpr duration no_queue = std::chrono::seconds{60};
constexpr auto queue_gap_m = 25.0;
/// So far beside its line a car steers round something.
constexpr auto steers_round_m = 0.1;

constexpr auto infinity = std::numeric_limits<double>::infinity();

double radius_m(const track& x) {
  return 0.5 * std::sqrt(x.length_m * x.length_m + x.width_m * x.width_m);
}

/// @returns the point `offset` (along, to the left) from a path's point.
point offset(const world::path_point& p, double along_m, double left_m) {
  const auto c = std::cos(p.heading_rad), s = std::sin(p.heading_rad);
  return p.at + point{along_m * c - left_m * s, along_m * s + left_m * c};
}

/// Leaves out what is behind the lead.
void put_in_order(const std::optional<lane_obstacle>& looks_past,
                  driving_scene& out) {
  assert(!out.lead || out.lead->speed_mps >= 0);
  if (out.lead)
    std::erase_if(out.beside, [&](const lane_obstacle& o) {
      return o.from_m > out.lead->rear_s_m;
    });
  if (looks_past)
    out.beside.push_back(*looks_past);
  std::ranges::sort(out.beside, {}, [](const lane_obstacle& o) {
    return std::tuple{o.from_m, o.low_m};
  });
}

} // namespace

scene_interpreter::scene_interpreter(known_way_ptr way, scene_params params)
    : way_{std::move(way)}, params_{params}, crossings_{way_,
                                                        params.car.width_m / 2
                                                            + params.margin_m,
                                                        params.foresight_s} {
  assert(params_.horizon_m > 0 && params_.margin_m >= 0);
}

void scene_interpreter::describe(time_point now, const own_place& me,
                                 std::span<const track> tracks,
                                 driving_scene& out,
                                 std::span<const told_drive> told) {
  assert(std::isfinite(me.s_m) && std::isfinite(me.d_m));
  out.at = now;
  out.lead.reset();
  out.crossings.clear();
  out.beside.clear();
  out.yields_m.clear();
  out.keep_free.clear();
  const thread_room lent{others_, near_, coming_};
  gather(now, me, tracks);
  const auto rear_m = me.s_m - params_.car.rear_m;
  const auto front_m = me.s_m + params_.car.front_m;
  crossings_.look_ahead(rear_m, front_m, front_m + params_.horizon_m,
                        out.keep_free);
  out.is_impatient =
      stands_s(now, me) > crossings_.patience_s(me.station, front_m);
  find_those_who_tell(now, told, out.agreed.has_value(), others_);
  if (params_.judges_crossings)
    crossings_.judge(
        {me.station, rear_m, front_m, me.speed_mps, out.is_impatient}, others_,
        out.keep_free, out.crossings, out.yields_m);
  if (!out.agreed) // who has agreed with others knows when they come
    add_claimed(now, route(), front_m, corridor_m(), out.keep_free, told,
                out.crossings);
  foresee_cutting_in();
  find_near(me);
  find_bodies(me, out);
  list_lead(now, route(), out.lead, corridor_m(), told, out.lead_told);
  assert(std::ranges::is_sorted(out.crossings, {}, &crossing_user::from_m));
  assert(std::ranges::is_sorted(out.beside, {}, &lane_obstacle::from_m));
}

double scene_interpreter::stands_s(time_point now, const own_place& me) {
  if (me.speed_mps > stands_below_mps)
    stands_since_.reset();
  else if (!stands_since_)
    stands_since_ = now;
  return stands_since_ ? to_seconds(now - *stands_since_) : 0;
}

/// @returns how far off a body may come to matter, m.
double scene_interpreter::reach_of(const track& x) const {
  const auto comes_m =
      params_.judges_crossings
          ? std::clamp(params_.foresight_s * x.motion.mean.col(1).norm(),
                       lane_network::at_line_m, lane_network::farthest_m)
          : 0.0;
  return comes_m + 2 * x.length_m + ample_m;
}

/// Brings the others, without the own vehicle, to the present.
void scene_interpreter::gather(time_point now, const own_place& me,
                               std::span<const track> tracks) {
  const auto& car = params_.car;
  const auto own_centre =
      offset(route().path().at(me.s_m), (car.front_m - car.rear_m) / 2, me.d_m);
  others_.clear();
  for (const auto& known : tracks) {
    assert(std::isfinite(known.heading_rad));
    if (me.station && known.station == me.station)
      continue;
    const auto far = known.centre() - own_centre;
    if (const auto least_m = params_.horizon_m + reach_of(known);
        dot(far, far) > least_m * least_m)
      continue; // neither on the way nor soon at a crossing of it
    auto x = predict(known, now);
    keep_to_lane(known, now, x);
    const auto apart = x.centre() - own_centre;
    if (!known.station
        && in_one_place(dot(apart, apart), x.narrow_m(), car.width_m))
      continue;
    assert(x.length_m > 0 && x.width_m > 0);
    others_.push_back({x});
  }
}

/// Who has not been seen for a moment is thought to follow its lane's bend.
void scene_interpreter::keep_to_lane(const track& known, time_point now,
                                     track& x) const {
  constexpr auto moment_s = 0.15;
  assert(x.id == known.id);
  const auto unseen_s = to_seconds(now - known.seen);
  if (unseen_s < moment_s)
    return;
  const auto speed_mps = known.speed_mps();
  if (speed_mps < stands_below_mps)
    return;
  auto then = known; // straight on since it was seen
  then.motion.mean.col(0) -=
      to_seconds(known.at - known.seen) * then.motion.mean.col(1);
  const auto bent = way_->lanes->moved_along(then, speed_mps * unseen_s);
  x.motion.mean = bent.motion.mean;
  x.heading_rad = bent.heading_rad;
  assert(x.motion.mean.allFinite());
}

/// Adds bodies where those who cut in will be soon.
void scene_interpreter::foresee_cutting_in() {
  const auto count = seen_ = others_.size();
  assert(way_->lanes);
  for (std::size_t i = 0; i < count; ++i)
    if (others_[i].cuts_in)
      for (const auto in_s : {0.7, 1.4}) {
        const auto& x = others_[i].x;
        const auto way_m = in_s * std::max(0.0, x.speed_mps());
        others_.push_back({way_->lanes->moved_along(x, way_m)});
      }
  assert(others_.size() >= count);
}

/// Finds, by the beads, the places on the way ahead where bodies may reach
/// into the lane; several of one body where the way returns to it.
void scene_interpreter::find_near(const own_place& me) {
  const auto count = static_cast<std::int64_t>(way_->beads.size());
  assert(count > 0 && way_->bead_m > 0);
  const auto front_m = me.s_m + params_.car.front_m;
  const auto at_front =
      static_cast<std::int64_t>(std::floor(front_m / way_->bead_m)) - 1;
  auto last = static_cast<std::int64_t>(
                  std::ceil((front_m + params_.horizon_m) / way_->bead_m))
              + 1;
  if (!route().closed())
    last = std::clamp<std::int64_t>(last, 0, count - 1);
  near_.clear();
  for (std::size_t who = 0; who < others_.size(); ++who) {
    const auto& x = others_[who].x;
    // The middle of a long one may be far behind.
    auto first =
        at_front - static_cast<std::int64_t>(radius_m(x) / way_->bead_m);
    if (!route().closed())
      first = std::clamp<std::int64_t>(first, 0, count - 1);
    const auto start = (first % count + count) % count; // on the lap
    assert(first <= last && start >= 0 && start < count);
    const auto reach_m = radius_m(x) + std::max(way_->half_lane_m, corridor_m())
                         + way_->bead_m / 2;
    auto away_m = [&](std::int64_t i) {
      const auto on_lap = start + (i - first);
      assert(on_lap >= 0);
      return distance_m(x.centre(),
                        way_->beads[static_cast<std::size_t>(
                            on_lap < count ? on_lap : on_lap % count)]);
    };
    auto before_m = infinity;
    for (auto i = first; i <= last;) {
      const auto here_m = away_m(i);
      if (here_m > reach_m) { // it takes so many beads to come near
        i += 1 + static_cast<std::int64_t>((here_m - reach_m) / way_->bead_m);
        before_m = infinity;
        continue;
      }
      if (here_m < before_m && (i == last || here_m <= away_m(i + 1))) {
        const auto guess_m = static_cast<double>(i) * way_->bead_m;
        assert(std::isfinite(guess_m));
        near_.push_back({guess_m - way_->bead_m - radius_m(x), guess_m, who});
      }
      before_m = here_m;
      ++i;
    }
  }
  std::ranges::sort(near_, {}, [](const near& n) {
    return std::tuple{n.low_m, n.who};
  });
}

/// Measures a body that comes towards the car as it will be where they meet:
/// by then it has followed its lane, and turned with it.
/// @param b  As it is now.
std::optional<body_footprint>
scene_interpreter::measure_met(const own_place& me, const near& where,
                               const body_footprint& b) const {
  assert(b.speed_mps < 0 && me.speed_mps >= 0);
  assert(where.who < others_.size());
  const auto& x = others_[where.who].x;
  const auto way_m = b.from_m - me.s_m - params_.car.front_m;
  const auto in_s = std::max(0.0, way_m) / (me.speed_mps - b.speed_mps);
  const auto way_to_it_m = std::max(0.0, x.speed_mps()) * in_s;
  auto met = measure(way_->lanes->moved_along(x, way_to_it_m),
                     where.guess_m + b.speed_mps * in_s);
  if (met)
    met->from_m = b.from_m, met->to_m = b.to_m;
  return met;
}

/// @returns whether a body can only be passed: that has begun, whoever planned
/// it, and there is no way left to stop before it.
bool scene_interpreter::has_to_pass(const own_place& me, const track& x,
                                    const body_footprint& b) const {
  const auto way_m = b.from_m - me.s_m - params_.car.front_m;
  const auto to_left_m = -b.high_m > b.low_m ? me.d_m : -me.d_m;
  const auto has_begun = std::ranges::binary_search(were_beside_, x.id)
                         || to_left_m > steers_round_m;
  return has_begun
         && way_m < me.speed_mps
                        * (decides_within_s + me.speed_mps / (2 * stops_mps2));
}

/// @returns what a body takes of the way before the own rear, where the car
/// will be; nothing if it will have left.
std::optional<body_footprint>
scene_interpreter::measure_ahead(const own_place& me, const near& where) const {
  assert(where.who < others_.size() && way_->half_lane_m > 0);
  const auto front_m = me.s_m + params_.car.front_m;
  auto print = measure(others_[where.who].x, where.guess_m);
  if (!print || print->to_m <= me.s_m - params_.car.rear_m
      || print->from_m > front_m + params_.horizon_m)
    return {};
  if (print->speed_mps < -stands_below_mps && print->low_m < way_->half_lane_m
      && print->high_m > -way_->half_lane_m)
    print = measure_met(me, where, *print);
  if (print && where.who >= seen_ && print->from_m < front_m)
    return {}; // it would come into the side: braking does not help
  assert(!print || print->from_m <= print->to_m);
  return print;
}

/// @param pull_out_m  Besides what it keeps: it may turn out to be passable,
///                    and then there must be way to steer round it.
lead_vehicle scene_interpreter::leading(const own_place& me, const track& x,
                                        const body_footprint& b,
                                        double pull_out_m) const {
  const auto front_m = me.s_m + params_.car.front_m;
  const auto stop_m = me.speed_mps * me.speed_mps / (2 * calmly_mps2);
  const auto back_m = std::clamp(b.from_m - front_m - stop_m, 0.0, pull_out_m);
  assert(back_m >= 0 && b.to_m > front_m);
  return {x.station, b.from_m - back_m, std::max(b.speed_mps, 0.0),
          b.speed_mps > 0 ? std::min(x.accel_mps2 * b.cosine, 0.0) : 0};
}

/// @returns what keeps a car where it sees past what it is going to overtake.
std::optional<lane_obstacle>
scene_interpreter::look_past_lead(const own_place& me, const track& x,
                                  const body_footprint& b,
                                  const lead_vehicle& lead) const {
  const auto stands =
      look_past(b.high_m, lead.rear_s_m, b.half_lane_m, params_.car);
  assert(b.from_m <= b.to_m);
  const auto can_steer =
      stands && stands->from_m >= me.s_m + params_.car.front_m;
  return can_steer || looks_past_ == x.id ? stands : std::nullopt;
}

/// @returns whether a body blocks the lane by itself, where the opposite one
/// may be used: no crossing is near, and nothing else stands close behind it,
/// or all has stood for so long that it is no queue.
bool scene_interpreter::blocks_alone(
    const own_place& me, const near& where, const body_footprint& b,
    std::span<const way_stretch> keep_free) const {
  assert(where.who < seen_ && b.from_m <= b.to_m);
  assert(params_.sees_opposite_m >= 0);
  const auto& x = others_[where.who].x;
  const auto has_stood = [](const track& t, duration least) {
    return t.stands() && t.at - t.moved >= least;
  };
  const auto is_near = [&](const way_stretch& s) {
    return s.to_m > b.from_m - leaves_before_m
           && s.from_m < b.to_m + is_back_after_m + queue_gap_m;
  };
  const auto may_queue = [&](const near& n) {
    if (n.who == where.who || n.low_m > b.to_m + queue_gap_m)
      return false;
    const auto other = measure_ahead(me, n);
    return other && other->to_m > b.from_m
           && other->from_m < b.to_m + queue_gap_m
           && other->low_m < corridor_m() && other->high_m > -corridor_m()
           && !(has_stood(others_[n.who].x, no_queue)
                && has_stood(x, no_queue));
  };
  return params_.sees_opposite_m > 0 && has_stood(x, surely_stands)
         && std::ranges::none_of(keep_free, is_near)
         && std::ranges::none_of(near_, may_queue);
}

/// @returns whether who comes on the opposite lane leaves time to overtake.
bool scene_interpreter::has_time(const own_place& me, const near& where,
                                 const body_footprint& b) {
  assert(where.who < seen_ && b.from_m <= b.to_m);
  const auto& car = params_.car;
  const auto& x = others_[where.who].x;
  const auto rear_m = me.s_m - car.rear_m, front_m = me.s_m + car.front_m;
  const auto eye =
      offset(route().path().at(me.s_m), (car.front_m - car.rear_m) / 2, me.d_m);
  const auto sees_to_m =
      opposite_in_sight_m(route(), eye, b.from_m, params_.sees_opposite_m,
                          params_.houses, x.body());
  assert(sees_to_m >= b.from_m);
  coming_.clear();
  for (std::size_t i = 0; i < seen_; ++i)
    if (i != where.who)
      add_if_opposite(route(), rear_m, front_m + params_.horizon_m,
                      others_[i].x, coming_);
  return has_time_to_overtake(route(),
                              {rear_m, front_m, me.speed_mps, sees_to_m,
                               std::ranges::binary_search(were_beside_, x.id)},
                              {b.from_m, b.to_m}, coming_);
}

/// In a bend the car's front corner comes nearer to what is outside.
void scene_interpreter::add_swing(body_footprint& b) const {
  constexpr auto looked_at_every_m = 1.0, car_m = 5.0;
  auto left_1pm = 0.0, right_1pm = 0.0;
  for (auto s = b.from_m - car_m; s <= b.to_m; s += looked_at_every_m) {
    const auto on =
        route().closed() ? s : std::clamp(s, 0.0, route().length_m());
    const auto bends_1pm = route().path().at(on).curvature_1pm;
    left_1pm = std::max(left_1pm, bends_1pm);
    right_1pm = std::max(right_1pm, -bends_1pm);
  }
  assert(b.low_m <= b.high_m);
  if (b.low_m + b.high_m < 0)
    b.high_m += corridor::swing_m(left_1pm);
  else
    b.low_m -= corridor::swing_m(right_1pm);
}

void scene_interpreter::find_bodies(const own_place& me, driving_scene& out) {
  beside_.clear();
  std::optional<lane_obstacle> looks_past;
  const auto front_m = me.s_m + params_.car.front_m;
  const auto need_m = 2 * corridor_m();
  assert(need_m > 0 && !out.lead);
  for (const auto& where : near_) {
    if (out.lead && where.low_m > out.lead->rear_s_m)
      break;
    const auto print = measure_ahead(me, where);
    if (!print)
      continue;
    auto b = *print;
    add_swing(b);
    const auto& x = others_[where.who].x;
    if (others_[where.who].is_crossing && !is_along(b.cosine))
      continue;
    const auto is_in_the_way = [&](double margin_m) {
      return b.low_m - margin_m < corridor_m()
             && b.high_m + margin_m > -corridor_m();
    };
    const auto room_m =
        b.half_lane_m + std::max(-b.high_m, b.low_m); // on its better side
    const auto lacking_m = [&](double margin_m) {
      return is_in_the_way(margin_m)
                 ? std::max(0.0, need_m + margin_m - room_m + rounding_m)
                 : 0.0;
    };
    const auto passes = has_to_pass(me, x, b);
    auto margin_m = x.margin_m();
    const auto may_lack_m = passes ? 2 * params_.margin_m - least_room_to_pass_m
                            : std::ranges::binary_search(were_beside_, x.id)
                                ? hysteresis_m
                                : 0.0;
    if (passes) // what is uncertain is no reason to turn back now
      margin_m -= std::clamp(lacking_m(margin_m) - may_lack_m, 0.0, margin_m);
    const auto lacks_m = lacking_m(margin_m);
    const auto certainly_lacks_m = lacking_m(0);
    const auto left_m = route().left_m(b.from_m) - b.half_lane_m;
    const auto is_overtaken =
        lacks_m > may_lack_m + 2 * rounding_m && left_m > 0
        && need_m + margin_m <= b.half_lane_m + left_m - b.high_m
        && blocks_alone(me, where, b, out.keep_free);
    const auto fits_opposite =
        is_overtaken && (passes || has_time(me, where, b));
    b.low_m -= margin_m;
    b.high_m += margin_m;
    if (fits_opposite || lacks_m <= may_lack_m + 2 * rounding_m) {
      out.beside.push_back({b.from_m, b.to_m, b.low_m, b.high_m, b.speed_mps,
                            fits_opposite ? 0.0 : lacks_m,
                            fits_opposite ? left_m : 0.0});
      beside_.push_back(x.id);
    } else if (b.to_m > front_m
               && (!out.lead || b.from_m < out.lead->rear_s_m)) {
      out.lead = leading(me, x, b,
                         is_overtaken                           ? looks_past_m
                         : x.stands() && certainly_lacks_m <= 0 ? pulls_out_m
                                                                : 0.0);
      looks_past = is_overtaken ? look_past_lead(me, x, *print, *out.lead)
                                : std::nullopt;
      looks_past_ = looks_past ? x.id : 0;
    }
  }
  std::ranges::sort(beside_);
  were_beside_ = beside_;
  put_in_order(looks_past, out);
}

} // namespace sofof::planners
