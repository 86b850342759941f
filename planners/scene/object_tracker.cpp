// Everything on the road that somebody sees, as tracks.
#include "planners/scene/object_tracker.hpp"

#include "planners/scene/line_of_sight.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

namespace sofof::planners {

namespace {

using namespace std::chrono_literals;

/// Who has not been seen for longer is forgotten, unless sightings are rare.
constexpr duration memory = 1s;
/// Who is hidden is remembered for longer; what hides it was seen just now.
constexpr duration hidden_memory = 4s, just_now = 300ms;

/// Sightings that arrive later than this are useless.
constexpr duration max_delay = 500ms;

/// Of the chi-square distribution with 4 degrees of freedom (two of position,
/// two of velocity), the quantile 0.999 999: what a sensor tells of a body for
/// hours shall not make two of it.
constexpr auto gate = 33.38;

/// Bodies at one time; who was not seen for longest makes room for more. A
/// provider hears far more than a vehicle sees.
constexpr std::size_t max_tracks = 1024;

/// Of a new value in the low-passed ones, where values come at 10 Hz or more
/// often; all of one that comes after twice as long.
constexpr auto least_share = 0.5;
constexpr auto whole_after_s = 0.2;

/// How much what stands may turn and shift meanwhile, rad²/s and m²/s.
constexpr auto standing_rad2ps = 1e-7, standing_m2ps = 1e-4;

/// Of standard deviations: more is no chance.
constexpr auto no_chance = 4.5;

/// Of one update, the first bodies count; no road shows more at once.
constexpr std::size_t max_seen = 256;

/// Nothing on a road is faster, larger or farther away: no load that is carried
/// on one is 60 m long, nor what is left standing on one.
constexpr auto max_speed_mps = 100.0;
constexpr auto min_size_m = 0.01, max_size_m = 60.0;
constexpr auto most_distant_m = 1e7;
constexpr auto max_heading_rad = 1e6; // many laps, unwrapped

/// @returns whether its speed may be that of a body that stands.
bool may_stand(const track& x) {
  const auto deviation_mps = std::sqrt(x.motion.covariance(1, 1));
  return std::abs(x.speed_mps())
         <= stands_below_mps + no_chance * deviation_mps;
}

bool is_sound(const world::perceived_object& o) {
  // Comparisons with NaN are false.
  return std::abs(o.centre.x_m) <= most_distant_m
         && std::abs(o.centre.y_m) <= most_distant_m
         && std::abs(o.heading_rad) <= max_heading_rad
         && std::isfinite(o.accel_mps2)
         && std::abs(o.speed_mps) <= max_speed_mps && o.width_m >= min_size_m
         && o.width_m <= max_size_m && o.length_m >= min_size_m
         && o.length_m <= max_size_m;
}

} // namespace

sighting_noise noise_of(const world::sensor_params& sensor) {
  constexpr sighting_noise least{0.02, 0.02, 0.002};
  return {std::max(sensor.position_noise_m, least.position_m),
          std::max(sensor.speed_noise_mps, least.speed_mps),
          std::max(sensor.heading_noise_rad, least.heading_rad)};
}

duration sighting_rhythm::silence(double speed_mps) const {
  // Of numbers from outside: the comparison with NaN is false.
  const auto way_s = moved_m / std::abs(speed_mps);
  return way_s < to_seconds(at_latest) ? from_seconds(way_s) : at_latest;
}

object_tracker::object_tracker(sighting_noise noise, sighting_rhythm rhythm)
    : noise_{noise}, rhythm_{rhythm} {}

void object_tracker::update(time_point at,
                            std::span<const world::perceived_object> seen,
                            std::optional<point> eye) {
  eye_ = eye;
  if (!pass_time(at))
    return;
  sightings_.clear();
  for (const auto& o : seen.first(std::min(seen.size(), max_seen)))
    if (is_sound(o))
      sightings_.push_back(make_sighting(at, o));
  assert(sightings_.size() <= max_seen && tracks_.size() <= max_tracks);
  pairs_.clear();
  for (std::uint32_t t = 0; t < tracks_.size(); ++t)
    for (std::uint32_t s = 0; s < sightings_.size(); ++s)
      match(t, s);
  pair_up(at);
  for (const auto& s : sightings_)
    if (!s.is_known)
      give_birth(at, s);
  assert(std::ranges::is_sorted(tracks_, {}, &track::id));
}

void object_tracker::on_report(time_point at, station_id who,
                               const world::perceived_object& self) {
  if (!pass_time(at) || !is_sound(self))
    return;
  sightings_.assign(1, make_sighting(at, self));
  pairs_.clear();
  const auto named =
      std::ranges::find(tracks_, std::optional{who}, &track::station);
  if (named != tracks_.end()) {
    match(static_cast<std::uint32_t>(named - tracks_.begin()), 0);
    if (pairs_.empty())
      named->station.reset(); // it has followed somebody else
  }
  if (pairs_.empty())
    for (std::uint32_t t = 0; t < tracks_.size(); ++t)
      if (!tracks_[t].station)
        match(t, 0);
  pair_up(at);
  if (pairs_.empty())
    give_birth(at, sightings_.front());
  assert(pairs_.empty() || pairs_.front().track < tracks_.size());
  auto& self_track =
      pairs_.empty() ? tracks_.back() : tracks_[pairs_.front().track];
  self_track.station = who;
  assert(std::ranges::count(tracks_, self_track.station, &track::station) == 1);
}

/// Brings all tracks to `at`, if that is later, and forgets.
/// @returns whether a sighting of that time is worth having.
bool object_tracker::pass_time(time_point at) {
  if (at > newest_) {
    newest_ = at;
    forgotten_.clear();
    for (const auto& x : tracks_)
      if (const auto unseen = newest_ - x.seen;
          unseen > lifetime(x) && (unseen > hidden_memory || !is_hidden(x)))
        forgotten_.push_back(x.id);
    std::erase_if(tracks_, [&](const track& x) {
      return std::ranges::binary_search(forgotten_, x.id);
    });
    for (auto& x : tracks_)
      x = predict(x, newest_);
  }
  assert(at <= newest_);
  assert(std::ranges::all_of(tracks_, [&](const track& x) {
    return x.at == newest_ && x.seen <= x.at;
  }));
  return newest_ - at <= max_delay;
}

/// Long enough for the message after a lost one, which may be late.
duration object_tracker::lifetime(const track& x) const {
  const auto silence = rhythm_.silence(x.speed_mps());
  return std::max(memory, 2 * silence + max_delay);
}

/// @returns whether something else stands or drives before it now.
bool object_tracker::is_hidden(const track& x) const {
  if (!eye_)
    return false;
  const auto there = predict(x, newest_).centre();
  return std::ranges::any_of(tracks_, [&](const track& y) {
    return y.id != x.id && newest_ - y.seen < just_now
           && crosses(*eye_, there, predict(y, newest_).body());
  });
}

object_tracker::observation
object_tracker::make_sighting(time_point at,
                              const world::perceived_object& o) const {
  assert(is_sound(o));
  assert(at <= newest_);
  const auto across_mps = o.speed_mps * noise_.heading_rad;
  observation s{o, {}, false, false};
  s.motion.mean << o.centre.x_m, o.speed_mps * std::cos(o.heading_rad),
      o.centre.y_m, o.speed_mps * std::sin(o.heading_rad);
  s.motion.covariance.diagonal() << noise_.position_m * noise_.position_m,
      noise_.speed_mps * noise_.speed_mps + across_mps * across_mps;
  s.motion.advance(to_seconds(newest_ - at));
  return s;
}

/// Enters a track and a sighting as a pair, if they may be of one body.
void object_tracker::match(std::uint32_t t, std::uint32_t s) {
  assert(t < tracks_.size() && s < sightings_.size());
  const auto& x = tracks_[t];
  auto& other = sightings_[s];
  const auto distance2_m2 =
      (other.motion.mean.col(0) - x.motion.mean.col(0)).squaredNorm();
  const auto variance_m2 =
      x.motion.covariance(0, 0) + other.motion.covariance(0, 0);
  assert(variance_m2 > 0);
  const auto is_same =
      in_one_place(distance2_m2, x.narrow_m(),
                   std::min(other.object.length_m, other.object.width_m));
  if (distance2_m2 > gate * variance_m2 && !is_same)
    return; // as far apart, they are outside the gate whatever their speeds
  const auto [distance2, cost] = x.motion.compare(other.motion);
  assert(std::isfinite(cost)); // or pairs had no order
  other.is_known = other.is_known || is_same;
  if (distance2 <= gate || is_same)
    pairs_.push_back({distance2 <= gate, cost, t, s});
}

/// Lets tracks take sightings, the likeliest pairs first.
void object_tracker::pair_up(time_point at) {
  std::ranges::sort(pairs_, {}, [](const pair& p) {
    return std::tuple{!p.in_gate, p.cost, p.track, p.observation};
  });
  is_taken_.assign(tracks_.size(), 0);
  for (const auto& p : pairs_) {
    assert(p.track < tracks_.size() && p.observation < sightings_.size());
    auto& s = sightings_[p.observation];
    if (is_taken_[p.track] || s.is_taken)
      continue;
    assert(p.in_gate || s.is_known);
    is_taken_[p.track] = 1;
    s.is_known = s.is_taken = true;
    correct(tracks_[p.track], at, s, p.in_gate);
  }
}

/// What stands goes on standing as it does, so that all sightings count.
void object_tracker::turn(track& x, double heading_rad, double dt_s,
                          double share_of_new) const {
  const auto noise2 = noise_.heading_rad * noise_.heading_rad;
  const auto before2 = x.heading_variance + standing_rad2ps * dt_s;
  assert(noise2 > 0 && dt_s >= 0);
  const auto share = x.stands() ? before2 / (before2 + noise2) : share_of_new;
  x.heading_rad += share * wrap_angle(heading_rad - x.heading_rad);
  x.heading_variance = x.stands() ? (1 - share) * before2 : share * noise2;
}

/// All sightings count since it moved.
/// @param stood  Whether it may have, before this sighting.
void object_tracker::settle(track& x, const motion_estimate& seen, double dt_s,
                            bool stood) const {
  assert(x.rest && seen.covariance(0, 0) > 0 && dt_s >= 0);
  auto& [centre, variance_m2] = *x.rest;
  variance_m2 += standing_m2ps * dt_s;
  const auto share = variance_m2 / (variance_m2 + seen.covariance(0, 0));
  centre = centre + share * (seen.centre() - centre);
  variance_m2 *= 1 - share;
  const auto now2_m2 = x.motion.covariance(0, 0);
  const auto has_moved = distance_m(centre, x.motion.centre())
                         > no_chance * std::sqrt(variance_m2 + now2_m2);
  if (!stood || !may_stand(x) || has_moved)
    *x.rest = {x.motion.centre(), now2_m2};
  assert(x.rest->variance_m2 > 0);
}

/// @param fits  Else the track begins anew, unless the sighting is old.
void object_tracker::correct(track& x, time_point at, const observation& s,
                             bool fits) {
  assert(x.at == newest_ && at <= newest_);
  const auto stood = may_stand(x);
  if (fits)
    x.motion.fuse(s.motion);
  else if (at == newest_)
    x.motion = s.motion;
  settle(x, s.motion, std::max(0.0, to_seconds(at - x.seen)), stood);
  if (at < x.seen)
    return;
  const auto& o = s.object;
  const auto share_of_new =
      std::clamp(to_seconds(at - x.seen) / whole_after_s, least_share, 1.0);
  turn(x, o.heading_rad, to_seconds(at - x.seen), share_of_new);
  x.seen = at;
  if (!x.stands())
    x.moved = at;
  x.accel_mps2 += share_of_new * (o.accel_mps2 - x.accel_mps2);
  x.length_m += share_of_new * (o.length_m - x.length_m);
  x.width_m += share_of_new * (o.width_m - x.width_m);
  assert(x.width_m > 0 && x.length_m > 0);
}

void object_tracker::give_birth(time_point at, const observation& s) {
  if (tracks_.size() == max_tracks)
    tracks_.erase(std::ranges::min_element(tracks_, {}, &track::seen));
  assert(tracks_.size() < max_tracks);
  assert(tracks_.empty() || tracks_.back().id <= last_id_);
  const auto& o = s.object;
  tracks_.push_back({++last_id_,
                     {},
                     newest_,
                     at,
                     at,
                     s.motion,
                     o.heading_rad,
                     o.accel_mps2,
                     o.length_m,
                     o.width_m,
                     noise_.heading_rad * noise_.heading_rad,
                     resting_place{o.centre, s.motion.covariance(0, 0)}});
}

} // namespace sofof::planners
