// What became of a drive.
#include "experiments/judge/verdict.hpp"

#include "experiments/judge/fault.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace sofof::experiments::judge {

namespace {

/// A corner may be so far off all lanelets: many files leave gaps, m.
constexpr auto off_road_m = 0.2;

/// Obstacles that stand are always there, s.
constexpr auto always_s = 1e9;

constexpr auto tolerance_s = 1e-6;

oriented_box body_of(const driven_moment& m) {
  return world::body(m.car, {});
}

std::array<point, 4> corners_of(const oriented_box& box) {
  const point along{std::cos(box.heading_rad), std::sin(box.heading_rad)};
  const point left{-along.y_m, along.x_m};
  const auto l = box.length_m / 2 * along, w = box.width_m / 2 * left;
  return {box.centre + l + w, box.centre - l + w, box.centre - l - w,
          box.centre + l - w};
}

double distance_to_rim_m(const std::vector<point>& rim, point p) {
  auto least_m = 1e9;
  auto a = rim.back();
  for (const auto b : rim)
    least_m =
        std::min(least_m, distance_to_segment_m(p, std::exchange(a, b), b));
  return least_m;
}

bool is_in_place(const maps::goal_state& goal, point p) {
  return goal.places.empty()
         || std::ranges::any_of(
             goal.places, [p](const auto& place) { return place.contains(p); });
}

/// @returns in words what a goal asks for besides its place.
std::string asked(const maps::goal_state& goal, int begin, double step_s) {
  auto text =
      fmt::format("asked {:.1f} s to {:.1f} s", step_s * (goal.first - begin),
                  step_s * (goal.last - begin));
  if (goal.speed_mps)
    text += fmt::format(", {:.1f} m/s to {:.1f} m/s", goal.speed_mps->low,
                        goal.speed_mps->high);
  if (goal.heading_rad)
    text += fmt::format(", {:.2f} rad to {:.2f} rad", goal.heading_rad->low,
                        goal.heading_rad->high);
  return text;
}

} // namespace

std::string_view name_of(outcome x) {
  switch (x) {
    case outcome::reached:
      return "reached";
    case outcome::collided:
      return "collided";
    case outcome::off_road:
      return "off road";
    case outcome::late:
      return "late";
    case outcome::no_route:
      return "no route";
    case outcome::refused:
      break;
  }
  return "refused";
}

drive_judge::drive_judge(const problem_scenario& what) : what_{what} {
  const auto& scene = what.scene;
  for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
    const auto& body = scene.bodies[k];
    std::vector<world::scripted_body::moment> moments;
    for (const auto& x : body.states)
      moments.push_back({scene.step_s * (x.step - what.problem.begin), x.at,
                         x.heading_rad, x.speed_mps});
    if (!body.moves) {
      moments.push_back(moments.front());
      moments.front().t_s = -always_s;
      moments.back().t_s = always_s;
    }
    obstacles_.push_back({body.id,
                          !body.moves,
                          {obstacle_id(static_cast<std::uint32_t>(k)),
                           body.length_m, body.width_m, std::move(moments)}});
  }
  for (const auto& rim : scene.lanelets) {
    auto& made = lanelets_.emplace_back();
    made.rim.corners = rim;
    made.low = made.high = rim.front();
    for (const auto p : rim) {
      made.low = {std::min(made.low.x_m, p.x_m - off_road_m),
                  std::min(made.low.y_m, p.y_m - off_road_m)};
      made.high = {std::max(made.high.x_m, p.x_m + off_road_m),
                   std::max(made.high.y_m, p.y_m + off_road_m)};
    }
  }
}

const drive_judge::obstacle* drive_judge::find_touched(const oriented_box& box,
                                                       double t_s) const {
  for (const auto& one : obstacles_)
    if (const auto body = one.is.at(t_s); body && overlap(box, body->box))
      return &one;
  return nullptr;
}

bool drive_judge::is_near_road(point p) const {
  return std::ranges::any_of(lanelets_, [p](const outline& l) {
    return l.low.x_m <= p.x_m && p.x_m <= l.high.x_m && l.low.y_m <= p.y_m
           && p.y_m <= l.high.y_m
           && (l.rim.contains(p)
               || distance_to_rim_m(l.rim.corners, p) <= off_road_m);
  });
}

bool drive_judge::is_on_road(const oriented_box& box) const {
  return std::ranges::all_of(corners_of(box),
                             [this](point p) { return is_near_road(p); });
}

bool drive_judge::is_reached(const ks_state& x) const {
  return std::ranges::any_of(what_.problem.goals, [&](const auto& goal) {
    return goal.first <= x.step && x.step <= goal.last
           && (!goal.speed_mps || goal.speed_mps->holds(x.speed_mps))
           && (!goal.heading_rad
               || goal.heading_rad->holds_angle(x.heading_rad))
           && is_in_place(goal, x.at);
  });
}

verdict drive_judge::collided(std::span<const driven_moment> drive,
                              const obstacle& with) const {
  const auto found =
      with.stands ? fault{} : whose_fault(drive, *what_.way, with.is);
  const auto& last = drive.back();
  return {outcome::collided, found.own, last.t_s,
          fmt::format("at {:.1f} m/s with {} {}{}", last.car.speed_mps,
                      with.stands ? "standing obstacle" : "obstacle", with.id,
                      found.own ? ", own fault" : " " + found.why),
          0};
}

std::vector<ks_state>
drive_judge::states(std::span<const driven_moment> drive) const {
  if (drive.size() < 2)
    return {};
  return ks_states(drive, what_.scene.step_s, what_.problem.begin);
}

std::optional<verdict>
drive_judge::look(std::span<const driven_moment> drive) const {
  const auto step_s = what_.scene.step_s;
  const auto all = states(drive);
  auto next = all.begin();
  for (std::size_t i = 0; i < drive.size(); ++i) {
    const auto so_far = drive.first(i + 1);
    const auto t_s = drive[i].t_s;
    if (const auto* with = find_touched(body_of(drive[i]), t_s))
      return collided(so_far, *with);
    for (; next != all.end()
           && step_s * (next->step - what_.problem.begin) <= t_s + tolerance_s;
         ++next) {
      const auto box = next->body();
      const auto then_s = step_s * (next->step - what_.problem.begin);
      if (const auto* with = find_touched(box, then_s))
        return collided(so_far, *with);
      if (!is_on_road(box))
        return verdict{outcome::off_road, false, then_s,
                       fmt::format("at {:.1f} m/s a corner was more than "
                                   "{:.1f} m off the lanelets",
                                   next->speed_mps, off_road_m),
                       0};
      if (is_reached(*next))
        return verdict{outcome::reached, false, then_s, {}, next->step};
    }
  }
  return std::nullopt;
}

verdict drive_judge::give_up(std::span<const driven_moment> drive) const {
  const auto& problem = what_.problem;
  const auto& goal = problem.goals.front();
  const auto step_s = what_.scene.step_s;
  verdict made{.what = outcome::late, .at_s = drive.back().t_s, .why = {}};
  const auto wanted = asked(goal, problem.begin, step_s);
  const auto all = states(drive);
  const auto is_there = [&](const ks_state& x) {
    return std::ranges::any_of(problem.goals, [&x](const auto& one) {
      return is_in_place(one, x.at);
    });
  };
  const auto first = std::ranges::find_if(all, is_there);
  if (first == all.end()) {
    made.why = fmt::format("never in the place, {:.1f} m/s in the end; {}",
                           drive.back().car.speed_mps, wanted);
    return made;
  }
  const auto last = std::find_if_not(first, all.end(), is_there) - 1;
  made.why = fmt::format("in the place from {:.1f} s to {:.1f} s with {:.1f} "
                         "m/s to {:.1f} m/s; {}",
                         step_s * (first->step - problem.begin),
                         step_s * (last->step - problem.begin),
                         first->speed_mps, last->speed_mps, wanted);
  return made;
}

} // namespace sofof::experiments::judge
