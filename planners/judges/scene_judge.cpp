// Whether what another computer makes of the bodies round a vehicle, on the
// vehicle's own way, may be used.
#include "planners/judges/scene_judge.hpp"

#include "planners/scene/body_footprint.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <tuple>

namespace sofof::planners {

namespace {

/// A car, where one is told.
constexpr auto usual_length_m = 4.0, usual_width_m = 1.8;

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
  // Who crosses may stand for a lead, or a body beside: if it is minded.
  std::array checks{find_impossible(told), find_added(x, houses, told),
                    hold_to_map(x, told),  hold_to_crossings(x, told),
                    hold_to_lead(x, told), hold_to_beside(x, told)};
  told.is_impatient = told.is_impatient && x.scene.is_impatient;
  sort_crossings(told);
  std::ranges::sort(told.beside, {}, [](const lane_obstacle& o) {
    return std::tuple{o.from_m, o.low_m};
  });
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

// -- bodies that it does not know ---------------------------------------------

/// @returns whether the vehicle knows of a body on a part of its way.
bool scene_judge::is_known_at(const own_knowledge& x, double from_m,
                              double to_m) const {
  return std::ranges::any_of(x.tracks, [&](const track& t) {
    const auto foot =
        measure_body(x.way, predict(t, x.scene.at),
                     {from_m, limits.looked_for_m, limits.corridor_m});
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
  // The room beside a body is known to centimetres only.
  const auto is_tight = [&](const lane_obstacle& o) {
    return o.lacks_m > 0 && o.from_m < until_m;
  };
  const auto has_reason = is_held(x.scene)
                          || std::ranges::any_of(x.scene.beside, is_tight)
                          || (x.stop_at_m && *x.stop_at_m < until_m);
  if (x.speed_mps > limits.waits_mps || has_reason || !is_held(told)) {
    waited_s_ = 0;
    return {};
  }
  waited_s_ += passed_s;
  assert(waited_s_ >= 0);
  return waited_s_ > limits.most_waited_s ? "waits" : "";
}

} // namespace sofof::planners
