// Where a vehicle is that is planned for from afar.
#include "planners/scene/ego_estimator.hpp"

#include "planners/scene/lane_motion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {
namespace {

/// A vehicle that is farther from its plan drives something else.
constexpr double followed_m = 5;
constexpr double followed_mps = 1;

/// Who is farther from the middle of its route drives another one.
constexpr double farthest_off_m = 5;

/// Nothing on a road is farther away.
constexpr double farthest_m = 1e7;

bool is_sound(const reported_state& x) {
  // Comparisons with NaN are false.
  return std::abs(x.position.x_m) <= farthest_m
         && std::abs(x.position.y_m) <= farthest_m
         && std::isfinite(x.heading_rad) && std::isfinite(x.speed_mps)
         && std::isfinite(x.accel_mps2) && std::isfinite(x.curvature_1pm);
}

} // namespace

ego_estimator::ego_estimator(world::route_ptr way, double s_m)
    : way_{std::move(way)}, first_s_m_{s_m} {
  assert(way_ && std::isfinite(first_s_m_));
}

void ego_estimator::on_report(const reported_state& told) {
  if (!is_sound(told) || (told_ && told.at <= told_->at))
    return;
  const auto guess_m = told_ ? at(told.at)->s_m : first_s_m_;
  assert(std::isfinite(guess_m));
  const auto foot = way_->path().project(told.position, guess_m);
  const auto centre = way_->path().at(foot.s_m);
  if (distance_m(centre.at, told.position) > farthest_off_m) {
    first_s_m_ = guess_m;
    told_.reset();
    return;
  }
  heard_ = {foot.s_m, foot.d_m,
            wrap_angle(told.heading_rad - centre.heading_rad),
            std::max(0.0, told.speed_mps)};
  assert(std::isfinite(heard_.s_m)
         && std::abs(heard_.d_m) < 2 * farthest_off_m);
  told_ = told;
}

void ego_estimator::follow(const world::trajectory& plan) {
  assert(!plan.empty());
  if (known_ > 0 && plan.start <= plan_.start)
    return;
  const moment start{plan.start, on_route(plan.points.front())};
  if (const auto before = planned(plan.start)) {
    const auto jump = start.where - *before;
    for (auto& x : starts_)
      x.where += jump;
  } else {
    known_ = 0;
  }
  newest_ = (newest_ + 1) % starts_.size();
  starts_[newest_] = start;
  known_ = std::min(known_ + 1, starts_.size());
  assert(known_ == 1 || this->start(1).at == plan_.start); // the one before
  plan_.start = plan.start;
  plan_.points.assign(plan.points.begin(), plan.points.end());
}

std::optional<planning_input> ego_estimator::at(time_point now) const {
  if (!told_)
    return std::nullopt;
  const auto off = off_plan(now);
  auto x = off ? along_plan(now, *off) : alone(now);
  x.at = now;
  return made_possible(x);
}

/// Motion that was told, against the plan then; nothing if the plans do not
/// say how it went on until `now`, or it does not follow them.
std::optional<ego_estimator::motion>
ego_estimator::off_plan(time_point now) const {
  assert(told_);
  if (known_ == 0 || now < plan_.start || now > plan_.end())
    return std::nullopt;
  const auto then = planned(told_->at);
  if (!then)
    return std::nullopt;
  assert(told_->at <= plan_.end());
  const auto off = heard_ - *then;
  if (std::abs(off.s_m) > followed_m || std::abs(off.speed_mps) > followed_mps)
    return std::nullopt;
  return off;
}

planning_input ego_estimator::along_plan(time_point now,
                                         const motion& off) const {
  auto x = seen_from(*way_, plan_.at(now));
  x.s_m += off.s_m;
  x.d_m += off.d_m;
  x.heading_error_rad += off.heading_error_rad;
  x.speed_mps = std::max(0.0, x.speed_mps + off.speed_mps);
  return x;
}

planning_input ego_estimator::alone(time_point now) const {
  assert(told_);
  const auto& line = way_->path();
  const auto bend = told_->curvature_1pm - line.at(heard_.s_m).curvature_1pm;
  planning_input x;
  x.at = told_->at;
  x.s_m = heard_.s_m;
  x.d_m = heard_.d_m;
  x.heading_error_rad = heard_.heading_error_rad;
  x.speed_mps = heard_.speed_mps;
  x.accel_mps2 = told_->accel_mps2;
  x = moved_forward(made_possible(x), now);
  assert(x.speed_mps >= 0 && x.at >= told_->at);
  x.curvature_1pm = line.at(x.s_m).curvature_1pm + bend;
  return x;
}

/// Where the plans had the vehicle at a time.
std::optional<ego_estimator::motion>
ego_estimator::planned(time_point t) const {
  if (known_ == 0 || t > plan_.end() || t < start(known_ - 1).at)
    return std::nullopt;
  if (t >= plan_.start)
    return on_route(plan_.at(t));
  std::size_t age = 1;
  for (; t < start(age).at; ++age)
    assert(age + 1 < known_);
  assert(start(age).at <= t && t < start(age - 1).at);
  return between(start(age), start(age - 1), t);
}

ego_estimator::motion ego_estimator::between(const moment& a, const moment& b,
                                             time_point t) {
  assert(a.at <= t && t <= b.at);
  assert(a.at < b.at);
  const auto h_s = to_seconds(b.at - a.at);
  const auto x = to_seconds(t - a.at) / h_s, rest = 1 - x;
  const auto way = b.where - a.where;
  // The cubic with these speeds at its ends.
  const auto s_m =
      x * x * (3 - 2 * x) * way.s_m
      + h_s * x * rest * (rest * a.where.speed_mps - x * b.where.speed_mps);
  return {a.where.s_m + s_m, a.where.d_m + x * way.d_m,
          a.where.heading_error_rad + x * way.heading_error_rad,
          a.where.speed_mps + x * way.speed_mps};
}

ego_estimator::motion
ego_estimator::on_route(const world::trajectory_point& p) const {
  const auto x = seen_from(*way_, p);
  return {x.s_m, x.d_m, x.heading_error_rad, x.speed_mps};
}

} // namespace sofof::planners
