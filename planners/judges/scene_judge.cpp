// Whether what another computer makes of the bodies round a vehicle, on the
// vehicle's own way, may be used.
#include "planners/judges/scene_judge.hpp"

#include "planners/scene/body_footprint.hpp"
#include "planners/scene/corridor.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <tuple>

namespace sofof::planners {

namespace {

constexpr auto corridor_half_m = corridor::room_beside_m / 2;
/// A body is looked for on the way so far from where it is told to be.
constexpr auto looked_for_within_m = 20.0;
/// A car, where one is told.
constexpr auto usual_length_m = 4.0, usual_width_m = 1.8;
/// A lead that drives as it tells may speed up by so much.
constexpr auto lead_speeds_up_mps2 = 3.0;

bool meet(double a_from_m, double a_to_m, double b_from_m, double b_to_m,
          double slack_m) {
  return a_from_m <= b_to_m + slack_m && b_from_m <= a_to_m + slack_m;
}

/// @returns whether `to` has a stretch, or parts of one, where `x` is.
bool has(std::span<const way_stretch> to, const way_stretch& x, double off_m) {
  return std::ranges::any_of(to, [&](const way_stretch& y) {
    return y.from_m <= x.from_m + off_m && y.to_m >= x.to_m - off_m;
  });
}

bool has(std::span<const double> to, double x, double off_m) {
  return std::ranges::any_of(
      to, [&](double y) { return std::abs(y - x) <= off_m; });
}

/// @returns whether two lists tell the same of the way between two places.
template <class List, class Place>
bool are_alike(const List& one, const List& other, double from_m, double to_m,
               double off_m, Place place_of) {
  const auto all_in = [&](const List& some, const List& in) {
    return std::ranges::all_of(some, [&](const auto& x) {
      const auto [begin_m, end_m] = place_of(x);
      return begin_m < from_m || end_m > to_m || has(in, x, off_m);
    });
  };
  return all_in(one, other) && all_in(other, one);
}

void sort_lists(driving_scene& x) {
  std::ranges::sort(x.crossings, {}, [](const crossing_user& c) {
    return std::tuple{c.from_m, c.to_m, c.body};
  });
  std::ranges::sort(x.beside, {}, [](const lane_obstacle& o) {
    return std::tuple{o.from_m, o.low_m};
  });
}

} // namespace

scene_judge::scene_judge(const world::vehicle_params& car,
                         const sighting_noise& noise)
    : car_{car} {
  constexpr auto sure = 4.0; // standard deviations
  const sighting_noise good;
  const auto more = [](double here, double there) {
    return std::max(0.0, here - there);
  };
  uncertain_m_ =
      sure
      * (more(noise.position_m, good.position_m)
         + usual_length_m / 2 * more(noise.heading_rad, good.heading_rad));
  assert(uncertain_m_ >= 0);
}

double scene_judge::matters_to_m(const own_knowledge& x) const {
  const auto v = x.speed_mps;
  return front_m(x) + limits.ample_m + v * v / (2 * limits.calmly_mps2);
}

scene_verdict scene_judge::judge(const own_knowledge& x,
                                 const line_of_sight& houses,
                                 driving_scene& told) {
  assert(std::isfinite(x.s_m) && x.speed_mps >= 0);
  assert(!judged_at_ || *judged_at_ <= x.now);
  const auto passed_s = judged_at_ ? std::min(to_seconds(x.now - *judged_at_),
                                              limits.longest_pause_s)
                                   : 0;
  judged_at_ = x.now;
  if (!looked_at_ || *looked_at_ < x.look.seen_at) {
    own_.look(x.look);
    looked_at_ = x.look.seen_at;
  }
  assert(passed_s >= 0);
  const auto waits = wait(x, told, passed_s); // before it is more cautious
  std::array checks{find_impossible(told),   find_added(x, houses, told),
                    hold_to_map(x, told),    hold_to_lead(x, told),
                    hold_to_beside(x, told), hold_to_crossings(x, told)};
  told.is_impatient = told.is_impatient && x.scene.is_impatient;
  sort_lists(told);
  if (!waits.empty())
    return {objection{waits, waited_s_, limits.most_waited_s}};
  const auto found = std::ranges::find_if(
      checks, [](std::string_view check) { return !check.empty(); });
  return {doubt_.add(found == checks.end() ? "" : *found, passed_s)};
}

std::string_view scene_judge::find_impossible(const driving_scene& told) {
  const auto is_possible = [](double speed_mps, double accel_mps2) {
    return std::abs(speed_mps) < limits.most_speed_mps
           && std::abs(accel_mps2) < limits.most_accel_mps2;
  };
  const auto all =
      (!told.lead || is_possible(told.lead->speed_mps, told.lead->accel_mps2))
      && std::ranges::all_of(told.beside, [&](const auto& o) {
           return is_possible(o.speed_mps, 0);
         });
  return all ? "" : "limits";
}

/// Where crossings begin and end, the own map knows.
std::string_view scene_judge::hold_to_map(const own_knowledge& x,
                                          driving_scene& told) const {
  const auto from_m = front_m(x) + limits.map_from_m;
  const auto to_m = front_m(x) + limits.map_to_m;
  assert(from_m < to_m);
  const auto stretch = [](const way_stretch& s) {
    return std::pair{s.from_m, s.to_m};
  };
  const auto place = [](double at_m) { return std::pair{at_m, at_m}; };
  if (are_alike(told.keep_free, x.scene.keep_free, from_m, to_m, limits.map_m,
                stretch)
      && are_alike(told.yields_m, x.scene.yields_m, from_m, to_m, limits.map_m,
                   place))
    return {};
  told.keep_free = x.scene.keep_free;
  told.yields_m = x.scene.yields_m;
  return "map";
}

// -- bodies that the vehicle knows --------------------------------------------

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
                     {at_m, looked_for_within_m, corridor_half_m});
    if (!foot || foot->from_m < at_m - limits.along_m
        || foot->from_m > at_m + limits.pulls_out_m
        || foot->low_m > corridor_half_m || foot->high_m < -corridor_half_m)
      continue;
    any = true;
    if (std::ranges::none_of(told.beside, [&](const lane_obstacle& o) {
          return o.left_m <= 0 && o.lacks_m < limits.most_lacking_m
                 && meet(o.from_m, o.to_m, foot->from_m, foot->to_m, 0)
                 && o.low_m <= foot->low_m + limits.beside_m + uncertain_m_
                 && o.high_m >= foot->high_m - limits.beside_m - uncertain_m_;
        }))
      return false;
  }
  return any;
}

bool scene_judge::is_covered(const own_knowledge& x, const lead_vehicle& lead,
                             const driving_scene& told) const {
  assert(std::isfinite(lead.rear_s_m));
  const auto off_m = limits.along_m + limits.for_speed_s * lead.speed_mps;
  if (told.lead && told.lead->rear_s_m <= lead.rear_s_m + off_m) {
    const auto is_same = told.lead->rear_s_m > lead.rear_s_m - off_m;
    return !is_same
           || told.lead->speed_mps <= lead.speed_mps + limits.faster_mps;
  }
  const auto crosses_there =
      std::ranges::any_of(told.crossings, [&](const crossing_user& c) {
        return c.enter_s < limits.here_s
               && meet(c.from_m, c.to_m, lead.rear_s_m,
                       lead.rear_s_m + looked_for_within_m / 2, off_m);
      });
  return crosses_there || is_passed(x, lead.rear_s_m, told);
}

std::string_view scene_judge::hold_to_lead(const own_knowledge& x,
                                           driving_scene& told) const {
  std::string_view check;
  const auto& lead = x.scene.lead;
  if (lead && lead->rear_s_m < matters_to_m(x) && !is_covered(x, *lead, told)) {
    told.lead = lead;
    told.lead_told.clear();
    std::erase_if(told.beside, [&](const lane_obstacle& o) {
      return o.from_m > lead->rear_s_m;
    });
    check = "lead";
  }
  // It tells to be ahead of what it can be.
  if (told.lead
      && std::ranges::any_of(told.lead_told, [&](const way_moment& m) {
           const auto v = told.lead->speed_mps + limits.faster_mps;
           return m.s_m - told.lead->rear_s_m
                  > limits.along_m
                        + m.t_s * (v + m.t_s * lead_speeds_up_mps2 / 2);
         })) {
    told.lead_told.clear();
    check = "lead";
  }
  assert(check.empty() || told.lead);
  assert(check.empty() || told.lead_told.empty());
  return check;
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
    if (own.from_m > matters_to_m(x) || own.to_m < front_m(x)
        || own.low_m > nearest_m || own.high_m < -nearest_m
        || (told.lead && told.lead->rear_s_m <= own.from_m + off_m))
      continue;
    const auto same = std::ranges::find_if(told.beside, [&](const auto& o) {
      return meet(o.from_m, o.to_m, own.from_m, own.to_m, off_m)
             && meet(o.low_m, o.high_m, own.low_m, own.high_m,
                     limits.beside_m + uncertain_m_);
    });
    const auto crosses_there =
        std::ranges::any_of(told.crossings, [&](const crossing_user& c) {
          return c.enter_s < limits.here_s
                 && meet(c.from_m, c.to_m, own.from_m, own.to_m, off_m);
        });
    if (crosses_there)
      continue;
    if (same == told.beside.end()) {
      // Who hardly reaches so far may be out of the lane for others.
      if (std::min(nearest_m - own.low_m, own.high_m + nearest_m)
          > limits.beside_m + uncertain_m_)
        check = "beside";
      told.beside.push_back(own);
      continue;
    }
    const auto farther_m =
        std::max(same->low_m - own.low_m, own.high_m - same->high_m);
    if (farther_m > limits.beside_m + uncertain_m_ + moves_m)
      check = "beside";
    if (farther_m > limits.widened_m + moves_m) {
      same->low_m = std::min(same->low_m, own.low_m);
      same->high_m = std::max(same->high_m, own.high_m);
    }
  }
  assert(told.beside.size() >= before);
  return check;
}

std::string_view scene_judge::hold_to_crossings(const own_knowledge& x,
                                                driving_scene& told) const {
  std::string_view check;
  const auto count = told.crossings.size();
  for (const auto& own : x.scene.crossings) {
    if (!own.goes_first || own.from_m > matters_to_m(x)
        || own.enter_s > limits.foresight_s)
      continue;
    const auto is_told = [&](const crossing_user& c) {
      return c.goes_first
             && meet(c.from_m, c.to_m, own.from_m, own.to_m, limits.crossing_m)
             && c.enter_s <= own.enter_s + limits.crossing_s
             && c.leave_s >= own.leave_s - limits.crossing_s;
    };
    const auto first = told.crossings.begin();
    const auto last = first + static_cast<std::ptrdiff_t>(count);
    // Who stands may leave at any time.
    const auto stands = [&](const crossing_user& c) {
      return std::isinf(own.leave_s) && c.goes_first
             && c.enter_s <= own.enter_s + limits.crossing_s
             && meet(c.from_m, c.to_m, own.from_m, own.to_m, limits.crossing_m);
    };
    if (std::any_of(first, last, is_told) || std::any_of(first, last, stands))
      continue;
    told.crossings.push_back(own);
    check = "crossing";
  }
  assert(told.crossings.size() >= count);
  assert(check.empty() == (told.crossings.size() == count));
  return check;
}

// -- bodies that it does not know ---------------------------------------------

/// @returns whether the vehicle knows of a body on a part of its way.
bool scene_judge::is_known_at(const own_knowledge& x, double from_m,
                              double to_m) const {
  return std::ranges::any_of(x.tracks, [&](const track& t) {
    const auto foot =
        measure_body(x.way, predict(t, x.scene.at),
                     {from_m, looked_for_within_m, corridor_half_m});
    return foot && meet(foot->from_m, foot->to_m, from_m, to_m, limits.along_m);
  });
}

/// @returns whether a car that stood on the way there would be seen.
bool scene_judge::is_seen_empty(const own_knowledge& x,
                                const line_of_sight& houses,
                                double at_m) const {
  const auto here = x.way.path().at(at_m);
  return own_.overlooks(timed_body{x.look.seen_at,
                                   {here.at, here.heading_rad, 0, 0,
                                    usual_length_m, usual_width_m}},
                        houses);
}

std::string_view scene_judge::find_added(const own_knowledge& x,
                                         const line_of_sight& houses,
                                         const driving_scene& told) const {
  const auto to_m = matters_to_m(x);
  assert(std::isfinite(to_m));
  assert(to_m >= front_m(x));
  if (told.lead && told.lead->rear_s_m < to_m) {
    const auto rear_m = told.lead->rear_s_m;
    const auto off_m =
        limits.along_m + limits.for_speed_s * told.lead->speed_mps;
    const auto& own = x.scene.lead;
    const auto is_known = own && std::abs(own->rear_s_m - rear_m) < off_m;
    if (!is_known
        && !is_known_at(x, rear_m - off_m, rear_m + limits.pulls_out_m)
        && is_seen_empty(x, houses, rear_m + usual_length_m / 2))
      return "added";
  }
  for (const auto& c : told.crossings)
    if (c.enter_s <= 0 && c.from_m < to_m && c.from_m > front_m(x)
        && !is_known_at(x, c.from_m - limits.along_m, c.to_m + limits.along_m)
        && is_seen_empty(x, houses, c.from_m)
        && is_seen_empty(x, houses, (c.from_m + c.to_m) / 2)
        && is_seen_empty(x, houses, c.to_m))
      return "added";
  return {};
}

/// Who stands, and knows of no reason, is told one.
std::string_view scene_judge::wait(const own_knowledge& x,
                                   const driving_scene& told, double passed_s) {
  assert(passed_s >= 0);
  const auto until_m = front_m(x) + limits.waits_m;
  const auto is_held = [&](const driving_scene& s) {
    return (s.lead && s.lead->rear_s_m < until_m)
           || std::ranges::any_of(s.crossings, [&](const crossing_user& c) {
                return c.goes_first && c.from_m < until_m;
              });
  };
  const auto has_reason =
      is_held(x.scene) || (x.stop_at_m && *x.stop_at_m < until_m);
  if (x.speed_mps > limits.waits_mps || has_reason || !is_held(told)) {
    waited_s_ = 0;
    return {};
  }
  waited_s_ += passed_s;
  assert(waited_s_ >= 0);
  return waited_s_ > limits.most_waited_s ? "waits" : "";
}

} // namespace sofof::planners
