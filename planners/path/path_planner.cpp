// Planning paths on a grid that stays.
#include "planners/path/path_planner.hpp"

#include "planners/problems/thread_solvers.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {
namespace {

// Farther than this from its path a car begins a new one.
constexpr double same_place_m = 0.05;
constexpr double same_heading_rad = 0.03;
constexpr double same_curvature_1pm = 0.02;
/// A plan that misses the corridor by less may be driven all the same.
constexpr double reduced_margin_m = 0.1;
constexpr double curvature_max_1pm = 0.2;
constexpr double rate_max_1pm2 = 0.1;
constexpr double knots_off_m = 1e-9; // of sums of knots

} // namespace

bool path_planner::follows(const path_start& car) const {
  assert(path_.empty() || path_.ds_m == grid_.ds_m);
  assert(grid_.ds_m > 0);
  if (path_.empty() || car.s_m < path_.start_s_m
      || car.s_m >= path_.end_s_m() - path_.ds_m)
    return false;
  const auto x = path_.at_s(car.s_m).x;
  return std::abs(x.d_m - car.x.d_m) <= same_place_m
         && std::abs(x.heading_rad - car.x.heading_rad) <= same_heading_rad
         && std::abs(x.curvature_1pm - car.x.curvature_1pm)
                <= same_curvature_1pm;
}

ocp::solve_report path_planner::plan(const path_start& car,
                                     std::span<const passing> others,
                                     const ocp::budget& go_on) {
  auto& solver = thread_solvers::here().path;
  if (!follows(car)) {
    forget();
    solver.resume({});
    if (solve(solver, car.s_m, car.x, ocp::start::cold, others, go_on))
      adopt(solver, car.s_m, 0);
    return report_;
  }
  const auto passed =
      static_cast<int>((car.s_m - path_.start_s_m) / path_.ds_m);
  assert(passed >= 0 && passed + 1 < path_.size);
  assert(frozen_ == 0 || frozen_ == 1);
  const auto idle = passed == 0 && frozen_ == 1 && others.empty() && !narrowed_;
  if (idle && settled_)
    return report_;
  const auto first = static_cast<std::size_t>(passed) + 1;
  const auto s = path_.start_s_m + static_cast<double>(first) * path_.ds_m;
  const auto how = settled_ ? ocp::start::warm : ocp::start::cold;
  solver.resume(kept_);
  if (settled_)
    solver.shift(passed + 1 - frozen_);
  if (solve(solver, s, path_.knots[first].x, how, others, go_on))
    adopt(solver, s, static_cast<int>(first));
  // It may have moved on by a piece, but never from below the car.
  assert(path_.start_s_m <= car.s_m + knots_off_m);
  assert(car.s_m <= path_.end_s_m());
  return report_;
}

// A path goes on as it was planned, as a rule; where that leaves the corridor,
// as others have come, it may drift beyond before it comes back.
bool path_planner::solve(path_ocp& solver, double s_m, const path_state& from,
                         ocp::start how, std::span<const passing> others,
                         const ocp::budget& go_on) {
  return attempt(solver, s_m, from, how, others, corridor::steering::as_planned,
                 go_on)
         || (report_.status != ocp::solve_status::budget
             && attempt(solver, s_m, from, ocp::start::cold, others,
                        corridor::steering::drifts, go_on));
}

bool path_planner::attempt(path_ocp& solver, double s_m, const path_state& from,
                           ocp::start how, std::span<const passing> others,
                           corridor::steering steers,
                           const ocp::budget& go_on) {
  assert(grid_.steps >= 1 && grid_.steps <= ocp::most_steps);
  assert(grid_.ds_m > 0);
  const auto n = static_cast<std::size_t>(grid_.steps);
  lane_.move(*line_, s_m, grid_.ds_m, grid_.steps);
  corridor room;
  room.open(lane_);
  for (const auto& other : others)
    room.pass(other.body, other.side);
  room.admit(from, steers);
  narrowed_ = !others.empty();
  bends_.resize(2 * n + 1);
  wanted_.assign(n + 1, 0);
  for (std::size_t i = 0; i < bends_.size(); ++i)
    bends_[i] =
        line_->curvature_1pm(s_m + static_cast<double>(i) * grid_.ds_m / 2);

  path_problem problem;
  problem.steps = grid_.steps;
  problem.ds_m = grid_.ds_m;
  problem.start = from;
  problem.curvature_1pm = bends_;
  problem.wanted_m = wanted_;
  problem.discs = room.discs();
  problem.curvature_max_1pm =
      std::max(curvature_max_1pm, std::abs(from.curvature_1pm));
  problem.rate_max_1pm2 = rate_max_1pm2;
  report_ = solver.solve(problem, how, {}, go_on);
  if (how == ocp::start::warm && !ocp::publishable(report_.status))
    report_ = solver.solve(problem, ocp::start::cold, {}, go_on);
  settled_ = ocp::publishable(report_.status)
             || (report_.status == ocp::solve_status::soft_infeasible
                 && report_.iterations > 0
                 && room.contains(solver.offset_m(), solver.heading_rad(),
                                  std::min(reduced_margin_m,
                                           std::max(0.0, room.gap_m() / 2))));
  assert(!settled_ || solver.steps() == grid_.steps);
  assert(!settled_ || !std::isnan(report_.cost));
  return settled_;
}

// The solver's plan behind the knot that the car has passed last.
void path_planner::adopt(const path_ocp& solved, double s_m, int first) {
  assert(settled_ && std::isfinite(s_m));
  assert(first >= 0 && first <= path_.size);
  solved.keep(kept_);
  assert(!kept_.is_empty() && kept_.ds_m == grid_.ds_m);
  frozen_ = first > 0 ? 1 : 0;
  auto at = path_.knots.begin();
  if (frozen_)
    *at++ = path_.knots[static_cast<std::size_t>(first) - 1];
  for (int k = 0; k <= solved.steps(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    (at++)->x = {solved.offset_m()[i], solved.heading_rad()[i],
                 solved.curvature_1pm()[i]};
  }
  path_.ds_m = grid_.ds_m;
  path_.start_s_m = s_m - frozen_ * path_.ds_m;
  path_.size = static_cast<int>(at - path_.knots.begin());
  assert(path_.size >= 2 && path_.size <= planned_path::capacity);
  path_.measure([this](double s) { return line_->curvature_1pm(s); });
}

} // namespace sofof::planners
