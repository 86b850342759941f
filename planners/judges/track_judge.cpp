// Whether what another computer tells of the bodies round a vehicle may be
// used.
#include "planners/judges/track_judge.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <utility>

namespace sofof::planners {

namespace {

/// Nobody sees, or is told of, more bodies that matter.
constexpr std::size_t most_remembered = 128;
/// Looks are remembered for so long.
constexpr duration look_memory = std::chrono::milliseconds{900};
/// The averages of bodies that are not told any more are forgotten.
constexpr duration offset_memory = std::chrono::seconds{1};
/// A body may be in the place of another one so far from its middle, along
/// it and across.
constexpr double place_along_m = 2.5, place_across_m = 1.6;
/// Sensors err by no more standard deviations.
constexpr double sure_sigmas = 4;

double squared_m2(point a, point b) {
  const auto apart = a - b;
  return dot(apart, apart);
}

/// @returns whether a body is where its own motion does not lead.
/// @param most_m  Whoever is not that far away from it is left in peace.
bool is_elsewhere(const world::perceived_object& before,
                  const world::perceived_object& now, double passed_s,
                  double most_m) {
  assert(passed_s >= 0);
  assert(most_m > 0);
  const auto way_m =
      std::max(std::abs(before.speed_mps), std::abs(now.speed_mps)) * passed_s;
  if (squared_m2(before.centre, now.centre)
          < (most_m - way_m) * (most_m - way_m)
      && way_m < most_m)
    return false; // cheap, and mostly so
  return unexplained_m({time_point{}, before},
                       {time_point{} + from_seconds(passed_s), now})
         > most_m;
}

point facing(const world::perceived_object& x) {
  return {std::cos(x.heading_rad), std::sin(x.heading_rad)};
}

} // namespace

track_judge::track_judge(const sighting_noise& noise,
                         std::shared_ptr<const line_of_sight> houses)
    : noise_{noise}, worse_m_{std::max(0.0, noise.position_m
                                                - sighting_noise{}.position_m)},
      houses_{std::move(houses)} {
  assert(houses_);
}

track_verdict track_judge::judge(const judged_tracks& x) {
  assert(x.told.size() == x.ids.size());
  assert(!judged_at_ || *judged_at_ <= x.now);
  const auto passed_s = judged_at_ ? std::min(to_seconds(x.now - *judged_at_),
                                              limits.longest_pause_s)
                                   : 0;
  assert(passed_s >= 0);
  judged_at_ = x.now;
  besides_.clear();
  if (const auto age_s = to_seconds(x.now - x.at); age_s > limits.most_age_s)
    return {{}, objection{"age", age_s, limits.most_age_s}};
  auto found = find_impossible(x);
  if (to_seconds(x.now - x.look.seen_at) <= limits.look_age_s) {
    const auto near_m = matters_m(x);
    if (past_.empty() || past_.back().at < x.look.seen_at) {
      own_.look(x.look);
      remember(x, near_m);
    }
    const auto of_seen = look_for_seen(x);
    const auto of_told = look_for_told(x, near_m);
    if (found.empty())
      found = of_seen.empty() ? of_told : of_seen;
  }
  return {doubt_.add(found, passed_s), {}};
}

double track_judge::matters_m(const judged_tracks& x) const {
  const auto v = x.look.speed_mps;
  return limits.ample_m + v * v / (2 * limits.calmly_mps2);
}

/// Keeps what was seen near enough, the newest last.
void track_judge::remember(const judged_tracks& x, double matters_m) {
  assert(matters_m > 0);
  assert(past_.empty() || past_.back().at < x.look.seen_at);
  std::vector<world::perceived_object> room;
  if (!past_.empty() && x.look.seen_at - past_.front().at > look_memory) {
    room = std::move(past_.front().seen);
    past_.erase(past_.begin());
  }
  room.clear();
  for (const auto& o : x.look.seen)
    if (room.size() < most_remembered
        && squared_m2(o.centre, x.look.from.at) < matters_m * matters_m)
      room.push_back(o);
  assert(room.size() <= most_remembered);
  past_.push_back({x.look.seen_at, std::move(room)});
}

/// @returns the newest look that is not later than `t`.
const track_judge::past_look* track_judge::look_before(time_point t) const {
  const auto found = std::find_if(past_.rbegin(), past_.rend(),
                                  [t](const auto& x) { return x.at <= t; });
  return found == past_.rend() ? nullptr : &*found;
}

bool track_judge::was_there(const past_look& then,
                            const world::perceived_object& body,
                            time_point at) {
  const auto since_s = to_seconds(at - then.at);
  const auto before = moved_on(body, -since_s);
  const auto axis = facing(body);
  const auto drift_m = 0.5 * limits.drift_mps2 * since_s * since_s;
  assert(since_s >= 0);
  assert(drift_m >= 0);
  return std::ranges::any_of(then.seen, [&](const auto& o) {
    const auto apart = o.centre - before.centre;
    return std::abs(dot(axis, apart)) < place_along_m + drift_m
           && std::abs(cross(axis, apart)) < place_across_m + drift_m;
  });
}

// -- the bodies that are seen -------------------------------------------------

track_judge::comparison
track_judge::compare(const world::perceived_object& seen, point axis,
                     const world::perceived_object& told,
                     double apart_s) const {
  assert(apart_s >= 0);
  assert(std::abs(dot(axis, axis) - 1) < 1e-6);
  const auto apart = told.centre - seen.centre;
  const auto drift_m = 0.5 * limits.drift_mps2 * apart_s * apart_s
                       + sure_sigmas * worse_m_
                       + sure_sigmas * noise_.speed_mps * apart_s;
  assert(drift_m >= 0);
  comparison x{dot(axis, apart), cross(axis, apart), 0, false, false};
  x.in_place = std::abs(x.along_m) < limits.along_m + drift_m
               && std::abs(x.across_m) < limits.across_m + drift_m;
  if (!x.in_place)
    return x;
  const auto faster = told.speed_mps * facing(told) + -seen.speed_mps * axis;
  x.speed_mps = std::sqrt(dot(faster, faster));
  const auto turns_mps = std::abs(seen.speed_mps) * noise_.heading_rad;
  x.alike = x.speed_mps < limits.speed_mps + 2 * limits.drift_mps2 * apart_s
                              + sure_sigmas * (noise_.speed_mps + turns_mps)
            && told.length_m > seen.length_m - limits.length_m
            && told.width_m > seen.width_m - limits.width_m;
  return x;
}

/// @returns whether a slow body is told beside its place, look after look:
/// whatever its number, as who lies gives a new one each time.
bool track_judge::is_off_on_average(const world::perceived_object& seen,
                                    const comparison& how, time_point at) {
  if (std::abs(seen.speed_mps) > limits.slow_mps)
    return false;
  auto nearest_m2 = place_across_m * place_across_m;
  auto it = offsets_.end();
  for (auto o = offsets_.begin(); o != offsets_.end(); ++o)
    if (const auto m2 = squared_m2(o->of, seen.centre); m2 < nearest_m2) {
      nearest_m2 = m2;
      it = o;
    }
  if (it == offsets_.end()) {
    offsets_.push_back({seen.centre, how.along_m, how.across_m, 1, at});
    return false;
  }
  if (at > it->at) {
    it->of = seen.centre;
    ++it->looks;
    const auto share = std::max(1.0 / it->looks, limits.mean_share);
    assert(share > 0 && share <= 1);
    it->along_m += share * (how.along_m - it->along_m);
    it->across_m += share * (how.across_m - it->across_m);
    it->at = at;
  }
  const auto off_m = std::hypot(it->along_m, it->across_m);
  const auto uncertain_m =
      sure_sigmas * std::sqrt(limits.mean_share) * worse_m_;
  assert(it->looks >= 1);
  assert(uncertain_m >= 0);
  return it->looks >= limits.mean_of && off_m > limits.mean_m + uncertain_m;
}

/// Looks for each body that is seen among those that are told.
std::string_view track_judge::look_for_seen(const judged_tracks& x) {
  assert(!past_.empty());
  assert(x.told.size() == x.ids.size());
  const auto apart_s = std::abs(to_seconds(x.look.seen_at - x.at));
  told_.clear();
  for (const auto& o : x.told)
    told_.push_back(moved_on(o, to_seconds(x.look.seen_at - x.at)));
  std::erase_if(offsets_, [&](const offset& o) {
    return x.look.seen_at - o.at > offset_memory;
  });
  const auto seen_at = x.look.seen_at;
  const auto* lately = look_before(seen_at - from_seconds(limits.added_for_s));
  const auto* earlier = look_before(seen_at - from_seconds(limits.known_for_s));
  assert(!lately || lately->at <= seen_at);
  assert(!earlier || earlier->at <= seen_at);
  std::string_view check;
  for (const auto& body : past_.back().seen) {
    const auto axis = facing(body);
    auto is_near = false;
    std::optional<comparison> best; // of all who are told to be this one
    for (std::size_t k = 0; k < told_.size() && !(best && best->fits()); ++k) {
      const auto apart_m2 = squared_m2(told_[k].centre, body.centre);
      if (apart_m2 > limits.near_m * limits.near_m)
        continue;
      is_near = true;
      const auto how = compare(body, axis, told_[k], apart_s);
      if (how.in_place && how.alike && !(best && best->off_m() < how.off_m()))
        best = how;
    }
    const auto is_told = best && !is_off_on_average(body, *best, seen_at);
    if (is_told)
      continue;
    // Whoever begins knows nothing of former looks.
    if (!lately || was_there(*lately, body, seen_at))
      besides_.push_back(body);
    if (earlier && was_there(*earlier, body, seen_at))
      check = is_near ? "shifted" : "missing";
  }
  assert(besides_.size() <= past_.back().seen.size());
  return check;
}

// -- the bodies that are told -------------------------------------------------

/// Looks for each body that is told among those that are seen.
std::string_view track_judge::look_for_told(const judged_tracks& x,
                                            double matters_m) {
  const auto apart_s = to_seconds(x.look.seen_at - x.at);
  const auto drift_m = 0.5 * limits.drift_mps2 * apart_s * apart_s;
  assert(told_.size() == x.told.size());
  assert(drift_m >= 0);
  assert(matters_m > 0);
  for (const auto& o : told_) {
    const auto apart_m2 = squared_m2(o.centre, x.look.from.at);
    if (apart_m2 > matters_m * matters_m || apart_m2 < o.width_m * o.width_m)
      continue;
    const auto axis = facing(o);
    const auto is_seen = std::ranges::any_of(x.look.seen, [&](const auto& b) {
      const auto apart = b.centre - o.centre;
      return std::abs(dot(axis, apart)) < place_along_m + drift_m
             && std::abs(cross(axis, apart)) < place_across_m + drift_m;
    });
    if (!is_seen && own_.overlooks(timed_body{x.look.seen_at, o}, *houses_))
      return "added";
  }
  return {};
}

/// @returns whether a body that is told by a new number, near the vehicle, is
/// elsewhere than the nearest of those that moved like it and are gone.
bool track_judge::jumps_by_another_number(point from, double passed_s) const {
  const auto has = [](const auto& list, std::uint32_t id) {
    return std::ranges::binary_search(list, id, {},
                                      [](const auto& x) { return x.first; });
  };
  assert(passed_s > 0);
  return std::ranges::any_of(told_now_, [&](const auto& now) {
    const auto& [id, o] = now;
    if (squared_m2(o.centre, from) > limits.renamed_m * limits.renamed_m
        || has(told_before_, id))
      return false;
    const world::perceived_object* nearest = nullptr;
    for (const auto& [gone, was] : told_before_)
      if (std::abs(was.speed_mps - o.speed_mps) < limits.speed_mps
          && dot(facing(was), facing(o)) > limits.same_way
          && (!nearest
              || squared_m2(was.centre, o.centre)
                     < squared_m2(nearest->centre, o.centre))
          && !has(told_now_, gone))
        nearest = &was;
    return nearest && is_elsewhere(*nearest, o, passed_s, limits.jump_m);
  });
}

/// Whatever the place: a number or a motion that no road user has.
std::string_view track_judge::find_impossible(const judged_tracks& x) {
  assert(x.told.size() == x.ids.size());
  std::string_view check;
  const auto id_of = [](const auto& o) { return o.first; };
  std::swap(told_now_, told_before_);
  told_now_.clear();
  for (std::size_t k = 0; k < x.told.size(); ++k) {
    const auto& o = x.told[k];
    if (!(std::abs(o.speed_mps) < limits.most_speed_mps
          && std::abs(o.accel_mps2) < limits.most_accel_mps2
          && o.length_m < limits.most_length_m
          && o.width_m < limits.most_width_m))
      check = "limits";
    told_now_.emplace_back(x.ids[k], o);
  }
  if (!std::ranges::is_sorted(told_now_, {}, id_of))
    std::ranges::sort(told_now_, {}, id_of);
  assert(told_now_.size() == x.told.size());
  const auto passed_s = to_seconds(x.at - told_at_);
  std::size_t known = 0;
  auto before = told_before_.begin();
  for (const auto& [id, o] : told_now_) {
    before = std::find_if(before, told_before_.end(),
                          [id = id](const auto& y) { return y.first >= id; });
    if (before == told_before_.end() || passed_s <= 0)
      break;
    if (before->first != id)
      continue;
    ++known;
    if (is_elsewhere(before->second, o, passed_s, limits.jump_m))
      check = "jump";
  }
  if (known < told_now_.size() && known < told_before_.size() && passed_s > 0
      && passed_s < limits.longest_pause_s
      && jumps_by_another_number(x.look.from.at, passed_s))
    check = "jump";
  told_at_ = x.at;
  return check;
}

} // namespace sofof::planners
