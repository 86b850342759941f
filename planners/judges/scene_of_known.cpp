// What is told of the bodies that a vehicle knows itself: the lead, those
// beside its way, and those who cross it.
#include "planners/judges/scene_judge.hpp"
#include "planners/scene/body_footprint.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <string_view>
#include <tuple>

namespace sofof::planners {

namespace {

constexpr auto forever = std::numeric_limits<double>::infinity();

/// @returns how badly two fit who may be one, m and s.
double apart(const crossing_user& a, const crossing_user& b) {
  return std::abs(a.from_m - b.from_m) + std::abs(a.to_m - b.to_m)
         + std::abs(a.enter_s - b.enter_s);
}

} // namespace

/// @returns whether the bodies that stand where a lead is known are told to be
/// beside the way, as they are: who leaves hardly room enough is one or the
/// other.
bool scene_judge::is_passed(const own_knowledge& x, double at_m,
                            const driving_scene& told) const {
  assert(std::isfinite(at_m));
  auto any = false;
  for (const auto& t : x.tracks) {
    const auto foot =
        measure_body(x.way, predict(t, x.scene.at),
                     {at_m, limits.looked_for_m, limits.corridor_m});
    if (!foot || foot->from_m < at_m - limits.along_m
        || foot->from_m > at_m + limits.pulls_out_m
        || foot->low_m > limits.corridor_m || foot->high_m < -limits.corridor_m)
      continue;
    any = true;
    if (std::ranges::none_of(told.beside, [&](const lane_obstacle& o) {
          return o.left_m <= 0 && o.lacks_m < limits.most_lacking_m
                 && std::abs(o.speed_mps - foot->speed_mps) < limits.faster_mps
                 && meet(o.from_m, o.to_m, foot->from_m, foot->to_m, 0)
                 && o.low_m <= foot->low_m + limits.beside_m + uncertain_m_
                 && o.high_m >= foot->high_m - limits.beside_m - uncertain_m_;
        }))
      return false;
  }
  return any;
}

/// @returns whether a told lead, no faster than so, is met before a place. One
/// behind the own front leads nobody.
bool scene_judge::leads_before(const own_knowledge& x, double at_m,
                               double speed_mps,
                               const driving_scene& told) const {
  assert(std::isfinite(at_m));
  return told.lead && told.lead->rear_s_m > front_m(x)
         && told.lead->rear_s_m <= at_m
         && told.lead->speed_mps <= speed_mps + limits.faster_mps;
}

/// @returns when the known bodies that begin about a place have left the way,
/// at the soonest, or what is behind `to_m`, s; infinite: one of them stands.
double scene_judge::gone_s(const own_knowledge& x, double at_m,
                           double to_m) const {
  auto last_s = 0.0;
  assert(std::isfinite(at_m) && std::isfinite(to_m));
  for (const auto& t : x.tracks) {
    const auto now = predict(t, x.scene.at);
    const auto foot = measure_body(
        x.way, now, {at_m, limits.looked_for_m, limits.corridor_m});
    if (!foot || foot->from_m < at_m - limits.along_m
        || foot->from_m > at_m + limits.pulls_out_m)
      continue;
    if (now.stands())
      return forever;
    const auto way_rad = x.way.path().at(foot->from_m).heading_rad;
    const auto left_mps = now.speed_along_mps(way_rad + std::numbers::pi / 2);
    const auto aside_m = left_mps > 0 ? limits.corridor_m - foot->low_m
                                      : limits.corridor_m + foot->high_m;
    const auto aside_s = left_mps == 0 ? forever : aside_m / std::abs(left_mps);
    const auto along_s =
        foot->speed_mps > 0 ? (to_m - foot->from_m) / foot->speed_mps : forever;
    last_s = std::max(last_s, std::min(aside_s, along_s));
  }
  assert(last_s >= 0);
  return last_s;
}

/// @returns whether somebody who is told to cross first stands for the known
/// bodies of a place: is there, and for as long as they are.
bool scene_judge::crosses_as(const own_knowledge& x, const way_stretch& place,
                             double off_m, const driving_scene& told) const {
  assert(place.from_m <= place.to_m);
  return std::ranges::any_of(told.crossings, [&](const crossing_user& c) {
    return c.goes_first && c.enter_s < limits.here_s && c.leave_s > 0
           && meet(c.from_m, c.to_m, place.from_m, place.to_m, off_m)
           && c.leave_s >= gone_s(x, place.from_m, c.to_m) - limits.crossing_s;
  });
}

/// A lead that is told before the known one is driven at in its stead, so it
/// may not be faster. How the known one goes on, it tells the vehicle itself.
std::string_view scene_judge::hold_to_lead(const own_knowledge& x,
                                           driving_scene& told) const {
  std::string_view check;
  // It tells to be ahead of what it can be.
  if (told.lead
      && std::ranges::any_of(told.lead_told, [&](const way_moment& m) {
           const auto v = told.lead->speed_mps + limits.faster_mps;
           return m.s_m - told.lead->rear_s_m
                  > limits.along_m
                        + m.t_s * (v + m.t_s * limits.lead_speeds_up_mps2 / 2);
         })) {
    told.lead_told.clear();
    check = "lead";
  }
  const auto& own = x.scene.lead;
  const auto off_m =
      limits.along_m + limits.for_speed_s * (own ? own->speed_mps : 0);
  assert(std::isfinite(off_m));
  // Of another one the vehicle has heard no drive: it may stand.
  if (!own || !told.lead || told.lead->rear_s_m < own->rear_s_m - off_m)
    told.lead_told.clear();
  if (!own || own->rear_s_m >= matters_to_m(x))
    return check;
  const auto from_m = std::min(front_m(x), own->rear_s_m - off_m);
  assert(from_m <= front_m(x));
  if (told.lead && told.lead->rear_s_m > from_m
      && told.lead->rear_s_m <= own->rear_s_m + off_m) {
    if (told.lead->speed_mps > own->speed_mps + limits.faster_mps)
      check = "lead";
    if (told.lead->rear_s_m > own->rear_s_m - off_m)
      told.lead_told = x.scene.lead_told;
    if (told.lead->speed_mps > own->speed_mps) {
      told.lead->speed_mps = own->speed_mps;
      told.lead->accel_mps2 = std::min(told.lead->accel_mps2, own->accel_mps2);
    }
    return check;
  }
  const way_stretch place{own->rear_s_m,
                          own->rear_s_m + limits.looked_for_m / 2};
  if (crosses_as(x, place, off_m, told) || is_passed(x, own->rear_s_m, told))
    return check;
  told.lead = own;
  told.lead_told.clear();
  std::erase_if(told.beside, [&](const lane_obstacle& o) {
    return o.from_m > own->rear_s_m;
  });
  return "lead";
}

/// Of a body that the vehicle knows, told and known, the more cautious counts.
/// @returns whether they are no farther apart than two may see one body.
bool scene_judge::hold_body(const own_knowledge& x, const lane_obstacle& own,
                            lane_obstacle& told) const {
  const auto moves_m = std::abs(own.speed_mps) * limits.for_speed_s;
  const auto farther_m =
      std::max(told.low_m - own.low_m, own.high_m - told.high_m);
  const auto fits =
      farther_m <= limits.beside_m + uncertain_m_ + moves_m
      && std::abs(told.speed_mps - own.speed_mps) <= limits.faster_mps;
  // What has begun, or cannot be stopped any more, needs the room that is left.
  if (own.from_m <= front_m(x) || own.lacks_m > 0) {
    told = own;
    return fits;
  }
  const auto wider_m =
      std::max({0.0, own.low_m - told.low_m, told.high_m - own.high_m});
  if (farther_m > limits.widened_m + moves_m) {
    told.low_m = std::min(told.low_m, own.low_m);
    told.high_m = std::max(told.high_m, own.high_m);
  }
  told.from_m = std::min(told.from_m, own.from_m);
  told.to_m = std::max(told.to_m, own.to_m);
  told.speed_mps = own.speed_mps;
  told.left_m = std::min(told.left_m, own.left_m);
  told.lacks_m = std::min(told.lacks_m, wider_m); // else room is for it all
  assert(told.low_m <= told.high_m && told.lacks_m >= 0);
  return fits;
}

std::string_view scene_judge::hold_to_beside(const own_knowledge& x,
                                             driving_scene& told) const {
  std::string_view check;
  const auto nearest_m = car_.width_m / 2 + limits.touches_m;
  assert(nearest_m > 0);
  [[maybe_unused]] const auto before = told.beside.size();
  const auto known = x.scene.beside.size();
  for (std::size_t k = 0; k < known; ++k) {
    const auto& own = x.scene.beside[k];
    const auto moves_m = std::abs(own.speed_mps) * limits.for_speed_s;
    const auto off_m = limits.along_m + moves_m;
    assert(off_m >= limits.along_m);
    if (own.from_m > matters_to_m(x) || own.to_m < x.s_m - car_.rear_m
        || own.low_m > nearest_m || own.high_m < -nearest_m
        || leads_before(x, own.from_m + off_m, std::abs(own.speed_mps), told))
      continue;
    const auto same = std::ranges::find_if(told.beside, [&](const auto& o) {
      return meet(o.from_m, o.to_m, own.from_m, own.to_m, off_m)
             && meet(o.low_m, o.high_m, own.low_m, own.high_m,
                     limits.beside_m + uncertain_m_);
    });
    if (crosses_as(x, {own.from_m, own.to_m}, off_m, told))
      continue;
    if (same == told.beside.end()) {
      // Who hardly reaches so far may be out of the lane for others.
      if (std::min(nearest_m - own.low_m, own.high_m + nearest_m)
          > limits.beside_m + uncertain_m_)
        check = "beside";
      told.beside.push_back(own);
      continue;
    }
    if (!hold_body(x, own, *same))
      check = "beside";
  }
  // The opposite lane is free where the vehicle itself finds it free.
  for (auto& o : told.beside)
    if (o.left_m > 0
        && std::ranges::none_of(x.scene.beside, [&](const lane_obstacle& own) {
             return own.left_m > 0
                    && meet(o.from_m, o.to_m, own.from_m, own.to_m,
                            limits.along_m);
           }))
      o.left_m = 0;
  assert(told.beside.size() >= before);
  return check;
}

/// @returns whether somebody who is told to cross is minded as one who is known
/// has to be. Who stands may leave at any time.
bool scene_judge::crosses_like(const crossing_user& own,
                               const crossing_user& told) {
  return told.goes_first && own.goes_first
         && meet(told.from_m, told.to_m, own.from_m, own.to_m,
                 limits.crossing_m)
         && told.enter_s <= own.enter_s + limits.crossing_s
         && (std::isinf(own.leave_s)
             || told.leave_s >= own.leave_s - limits.crossing_s);
}

/// @returns whether a body that is known to be across a place already is told
/// as the lead: it leaves the place along the way.
bool scene_judge::leads_from(const own_knowledge& x, const crossing_user& own,
                             const driving_scene& told) const {
  assert(own.from_m <= own.to_m);
  if (own.enter_s > limits.here_s || !told.lead)
    return false;
  const auto rear_m = told.lead->rear_s_m;
  assert(std::isfinite(rear_m));
  return rear_m >= own.from_m && rear_m <= own.to_m
         && std::ranges::any_of(x.tracks, [&](const track& t) {
              const auto foot =
                  measure_body(x.way, predict(t, x.scene.at),
                               {rear_m, limits.looked_for_m,
                                limits.corridor_m + uncertain_m_});
              return foot
                     && std::abs(foot->from_m - rear_m)
                            <= limits.along_m
                                   + limits.for_speed_s * foot->speed_mps
                     && leads_before(x, own.to_m, foot->speed_mps, told);
            });
}

/// @returns whether a planner minds somebody of a known place in any case.
bool scene_judge::matters(const own_knowledge& x,
                          const crossing_user& own) const {
  return own.goes_first && own.from_m <= matters_to_m(x)
         && own.enter_s <= limits.foresight_s;
}

void scene_judge::sort_crossings(driving_scene& x) {
  std::ranges::sort(x.crossings, {}, [](const crossing_user& c) {
    return std::tuple{c.from_m, c.to_m, c.body};
  });
}

/// @returns whether a planner minds not all of those who cross first.
bool scene_judge::is_crowded(std::span<const crossing_user> users) {
  if (users.size() <= limits.most_minded)
    return false;
  std::size_t bodies = 0, places = 0;
  assert(limits.most_minded <= limits.most_places);
  for (std::size_t k = 0; k < users.size(); ++k) {
    const auto before = users.first(k);
    places += users[k].goes_first;
    bodies += users[k].goes_first
              && std::ranges::none_of(before, [&](const crossing_user& y) {
                   return y.goes_first && y.body == users[k].body;
                 });
  }
  assert(bodies <= places);
  return bodies > limits.most_minded || places > limits.most_places;
}

/// A planner minds so many that cross and no more: those that the vehicle knows
/// are among them. Of the others the farthest are left out.
void scene_judge::leave_out_far(const own_knowledge& x,
                                driving_scene& told) const {
  auto& all = told.crossings;
  assert(std::ranges::is_sorted(all, {}, &crossing_user::from_m));
  for (auto k = all.size(); k-- > 0 && is_crowded(all);)
    if (std::ranges::none_of(x.scene.crossings, [&](const crossing_user& own) {
          return matters(x, own) && crosses_like(own, all[k]);
        }))
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(k));
}

std::string_view scene_judge::hold_to_crossings(const own_knowledge& x,
                                                driving_scene& told) const {
  assert(std::isfinite(x.s_m) && x.speed_mps >= 0);
  std::string_view check;
  auto any = false;
  const auto count = told.crossings.size();
  assert(std::isfinite(matters_to_m(x)));
  for (const auto& own : x.scene.crossings) {
    if (!matters(x, own))
      continue;
    any = true;
    crossing_user* same = nullptr; // of all who may be this one
    for (std::size_t k = 0; k < count; ++k)
      if (auto& c = told.crossings[k]; crosses_like(own, c)) {
        c.brakes_mps2 = std::max(c.brakes_mps2, own.brakes_mps2);
        if (!same || apart(own, c) < apart(own, *same))
          same = &c;
      }
    if (same) {
      same->from_m = std::min(same->from_m, own.from_m);
      same->to_m = std::max(same->to_m, own.to_m);
      same->enter_s = std::min(same->enter_s, own.enter_s);
      if (std::isfinite(own.leave_s))
        same->leave_s = std::max(same->leave_s, own.leave_s);
      continue;
    }
    told.crossings.push_back(own);
    if (!leads_from(x, own, told))
      check = "crossing";
  }
  assert(told.crossings.size() >= count);
  assert(check.empty() || told.crossings.size() > count);
  if (any && is_crowded(told.crossings)) {
    sort_crossings(told);
    leave_out_far(x, told);
  }
  return check;
}

} // namespace sofof::planners
