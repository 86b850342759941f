// How fast to drive, so that one is in a goal's place when one should be.
#include "experiments/judge/speed_advice.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace sofof::experiments::judge {

namespace {

constexpr auto advised_step_m = 0.5;
/// How cars of ours drive about: who is slower than a limit by so much more,
/// m/s, accelerates by so much, m/s², up to the most.
constexpr auto per_mps = 0.25, advised_accel_mps2 = 1.5;
constexpr auto advised_decel_mps2 = 1.5, advised_aside_mps2 = 2.0;
/// Nobody is asked to brake harder than this.
constexpr auto gentle_mps2 = 1.0;
constexpr auto slowest_mps = 0.5;
constexpr auto anything_mps = std::numeric_limits<double>::infinity();

/// A stretch of the way, and when and how fast to be on it.
struct way_goal {
  double from_m = 0, to_m = 0;
  double first_s = 0, last_s = 0;
  double most_mps = anything_mps;
  double asked_mps = anything_mps; ///< Of a goal that is anywhere.
};

std::optional<way_goal> find_goal(const maps::planning_problem& problem,
                                  double step_s, const world::route& way,
                                  double start_m) {
  for (const auto& goal : problem.goals) {
    way_goal made{.from_m = start_m,
                  .to_m = way.length_m(),
                  .first_s = step_s * (goal.first - problem.begin),
                  .last_s = step_s * (goal.last - problem.begin)};
    if (goal.speed_mps)
      made.most_mps = std::max(slowest_mps, goal.speed_mps->high - 0.2);
    if (goal.places.empty()) {
      if (goal.speed_mps)
        made.asked_mps = std::max(
            slowest_mps, (goal.speed_mps->low + goal.speed_mps->high) / 2);
      return made;
    }
    const auto is_in = [&](double s_m) {
      const auto p = way.path().at(s_m).at;
      return std::ranges::any_of(
          goal.places, [p](const auto& place) { return place.contains(p); });
    };
    auto s_m = start_m;
    while (s_m < way.length_m() && !is_in(s_m))
      s_m += advised_step_m / 2;
    if (s_m >= way.length_m())
      continue;
    made.from_m = s_m;
    while (s_m < way.length_m() && is_in(s_m))
      s_m += advised_step_m / 2;
    made.to_m = s_m;
    return made;
  }
  return std::nullopt;
}

/// Who is faster than it shall be slows down gently.
struct speed_cap {
  double start_m, start_mps, cap_mps;

  double at(double s_m) const {
    const auto square =
        start_mps * start_mps - 2 * gentle_mps2 * std::max(0.0, s_m - start_m);
    return std::max(cap_mps, std::sqrt(std::max(0.0, square)));
  }

  /// @returns where it is reached.
  double reached_m() const {
    const auto over = start_mps * start_mps - cap_mps * cap_mps;
    return start_m + std::max(0.0, over) / (2 * gentle_mps2);
  }
};

/// How a car of ours drives along the way that nobody else is on.
class lone_car {
public:
  lone_car(const world::route& way, double start_m, double start_mps)
      : start_m_{start_m}, start_mps_{start_mps} {
    for (auto s_m = start_m; s_m < way.length_m(); s_m += advised_step_m) {
      const auto bend_1pm = std::abs(way.path().curvature_1pm(s_m));
      most_mps_.push_back(
          std::min(way.limit_mps(s_m),
                   std::sqrt(advised_aside_mps2 / std::max(bend_1pm, 1e-6))));
    }
  }

  speed_cap capped(double cap_mps) const {
    return {start_m_, start_mps_, cap_mps};
  }

  /// @returns when it is there if it drives no faster than that, s.
  double time_to(double s_m, double cap_mps) const {
    const auto cap = capped(cap_mps);
    auto most = most_mps_;
    for (std::size_t i = 0; i < most.size(); ++i)
      most[i] = std::min(
          most[i], cap.at(start_m_ + advised_step_m * static_cast<double>(i)));
    for (auto i = most.size(); i-- > 1;)
      most[i - 1] = std::min(
          most[i - 1], std::sqrt(most[i] * most[i]
                                 + 2 * advised_decel_mps2 * advised_step_m));
    auto v = start_mps_, t_s = 0.0, at_m = start_m_;
    for (const auto limit : most) {
      if (at_m >= s_m)
        break;
      const auto accel =
          v > limit ? -advised_decel_mps2
                    : std::min(advised_accel_mps2, per_mps * (limit - v));
      const auto next =
          std::sqrt(std::max(0.01, v * v + 2 * accel * advised_step_m));
      t_s += 2 * advised_step_m / std::max(v + next, 0.1);
      v = next;
      at_m += advised_step_m;
    }
    return t_s;
  }

private:
  double start_m_, start_mps_;
  std::vector<double> most_mps_;
};

/// @returns how fast to drive at most up to the goal.
double find_cap(const way_goal& goal, const lone_car& car) {
  constexpr auto overlap_s = 0.5, fastest_mps = 60.0;
  if (std::isfinite(goal.asked_mps))
    return goal.asked_mps;
  const auto long_s = goal.last_s - goal.first_s;
  const auto enough_s = std::min(overlap_s, long_s / 2);
  if (car.time_to(goal.to_m, fastest_mps) >= goal.first_s + enough_s)
    return anything_mps;
  const auto middle_m = (goal.from_m + goal.to_m) / 2;
  const auto then_s = goal.first_s + std::min(long_s / 2, 1.0);
  auto low = slowest_mps, high = fastest_mps;
  for (auto i = 0; i < 40; ++i) {
    const auto middle = (low + high) / 2;
    (car.time_to(middle_m, middle) < then_s ? high : low) = middle;
  }
  return low;
}

/// Bounds the limits of one lane of the way.
/// @param begin_m, end_m  Of the lane on the way.
void bound_limits(world::lane& lane, double begin_m, double end_m,
                  const way_goal& goal, const speed_cap& cap) {
  constexpr auto sooner_m = 3.0, every_m = 2.0;
  const auto from_m = goal.from_m - sooner_m;
  std::vector<double> breaks{0};
  for (const auto& zone : lane.limits)
    breaks.push_back(zone.from_m);
  const auto add = [&](double s_m) {
    if (s_m > begin_m && s_m < end_m)
      breaks.push_back(s_m - begin_m);
  };
  add(from_m);
  add(goal.to_m);
  if (std::isfinite(cap.cap_mps))
    for (auto s_m = cap.start_m; s_m < cap.reached_m() + every_m;
         s_m += every_m)
      add(s_m);
  std::ranges::sort(breaks);
  std::vector<world::speed_zone> zones;
  for (const auto at_m : breaks) {
    const auto zone = std::ranges::find_if(
        lane.limits.rbegin(), lane.limits.rend(),
        [at_m](const auto& z) { return z.from_m <= at_m; });
    auto limit_mps = zone->limit_mps;
    const auto s_m = begin_m + at_m;
    if (s_m < goal.to_m)
      limit_mps = std::min(limit_mps, cap.at(s_m));
    if (s_m >= from_m && s_m < goal.to_m)
      limit_mps = std::min(limit_mps, goal.most_mps);
    if (zones.empty() || at_m > zones.back().from_m + 0.01)
      zones.push_back({at_m, limit_mps});
    else
      zones.back().limit_mps = std::min(zones.back().limit_mps, limit_mps);
  }
  lane.limits = std::move(zones);
}

} // namespace

void advise_speeds(maps::imported_map& map,
                   const maps::planning_problem& problem, double step_s,
                   const world::route& way, double start_m) {
  const auto goal = find_goal(problem, step_s, way, start_m);
  if (!goal)
    return;
  const lone_car car{way, start_m, problem.speed_mps};
  const auto cap = car.capped(find_cap(*goal, car));
  const auto& lanes = map.routes.front().lanes;
  for (std::size_t k = 0; k < lanes.size(); ++k) {
    const auto lane =
        std::ranges::find(map.lanes, lanes[k], &world::lane::name);
    bound_limits(*lane, way.start_of_m(k), way.start_of_m(k + 1), *goal, cap);
  }
}

} // namespace sofof::experiments::judge
