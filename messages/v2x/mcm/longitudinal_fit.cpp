// Fitting way over time, from rest to rest.
#include "messages/v2x/mcm/longitudinal_fit.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::messages {
namespace {

constexpr double certainty(double sigma) {
  return 1 / (sigma * sigma);
}

// What rounding leaves when waypoints are well chosen.
constexpr double sigma_way_m = 0.004;
constexpr double sigma_speed_mps = 0.0025;

/// How much jerk changes from step to step, by how far moments are apart: their
/// sender sets them close where it changes.
double weight_of_kink(double gap_s) {
  return gap_s > 0.15   ? certainty(0.3)
         : gap_s > 0.07 ? certainty(1.2)
                        : certainty(20);
}
constexpr double widest_gap_s = 1;
constexpr double sigma_accel_mps2 = 3; // of anybody, any time

constexpr double sigma_before_mps = 0.003;
constexpr double sigma_before_mps2 = 0.02;

constexpr double slack = 0.02; // of a step: times are whole milliseconds

} // namespace

bool longitudinal_fit::fit(std::span<const moment> moments,
                           const motion* before, std::size_t steps) {
  assert(moments.size() >= 2);
  assert(steps >= 1 && steps <= most_steps);
  moments_ = moments;
  steps_ = steps;
  step_s_ = moments.back().t_s / static_cast<double>(steps);
  done_ = 0;
  for (std::size_t i = 0; done_ <= steps_;) {
    if (rests_from(i)) {
      i = rest(i);
      if (i + 1 == moments_.size())
        break;
    }
    auto next = i + 1;
    while (next < moments_.size() && !rests_from(next))
      ++next;
    if (!drive(i, next, i == 0 ? before : nullptr))
      return false;
    if (next == moments_.size())
      break;
    i = next;
  }
  while (done_ <= steps_)
    put({moments_.back().way_m, 0, 0});
  return true;
}

/// @returns whether the car stands from a moment to the next, or to the end.
bool longitudinal_fit::rests_from(std::size_t i) const {
  const auto last = i + 1 == moments_.size();
  return moments_[i].speed_mps <= 0 && (last || moments_[i + 1].speed_mps <= 0);
}

/// @returns the last moment of the rest.
std::size_t longitudinal_fit::rest(std::size_t i) {
  auto end = i;
  auto sum_m = 0.0;
  for (; end < moments_.size() && moments_[end].speed_mps <= 0; ++end)
    sum_m += moments_[end].way_m;
  const motion stands{sum_m / static_cast<double>(end - i), 0, 0};
  const auto until_s = end == moments_.size() ? moments_.back().t_s + step_s_
                                              : moments_[end - 1].t_s;
  while (done_ <= steps_ && time_of(done_) <= until_s + slack * step_s_)
    put(stands);
  return end - 1;
}

/// Fills the knots from one moment up to another, where it comes to rest, or
/// the end. The last bit to the rest is left out: brakes end with a step.
bool longitudinal_fit::drive(std::size_t from, std::size_t to,
                             const motion* before) {
  const auto stops = to < moments_.size();
  const auto slack_s = slack * step_s_;
  const auto first =
      static_cast<std::size_t>((moments_[from].t_s + slack_s) / step_s_);
  auto last = steps_;
  if (stops)
    last = static_cast<std::size_t>(
               std::max(1.0, std::ceil((moments_[to].t_s - slack_s) / step_s_)))
           - 1;
  if (last <= first) {
    if (done_ <= last)
      roll_out(from, to);
    return true;
  }

  const auto start_s = time_of(first);
  way_.begin(last - first, step_s_);
  const auto end_s = time_of(last) + slack_s;
  auto seen = from;
  for (; seen < to && moments_[seen].t_s <= end_s; ++seen)
    observe(seen, start_s);
  if (stops && moments_[seen - 1].t_s < time_of(last) - slack_s)
    observe(to, start_s); // or nothing would tell how it ends
  limit_jerk(from, seen, start_s, last - first);
  if (before != nullptr) {
    way_.observe_slope(0, before->speed_mps, certainty(sigma_before_mps));
    way_.observe_bend(0, before->accel_mps2, certainty(sigma_before_mps2));
  }
  if (!way_.solve())
    return false;
  while (done_ <= last) {
    const auto x = way_.at_knot(done_ - first);
    put(x.slope > 0 ? motion{x.value, x.slope, x.bend}
                    : motion{x.value, 0, std::max(x.bend, 0.0)});
  }
  return true;
}

void longitudinal_fit::observe(std::size_t i, double start_s) {
  const auto& x = moments_[i];
  way_.observe_value(x.t_s - start_s, x.way_m, certainty(sigma_way_m));
  way_.observe_slope(x.t_s - start_s, x.speed_mps, certainty(sigma_speed_mps));
}

void longitudinal_fit::limit_jerk(std::size_t from, std::size_t to,
                                  double start_s, std::size_t steps) {
  // The smallest gap around each knot.
  std::array<double, most_steps + 1> gap_s;
  std::fill_n(gap_s.begin(), steps + 1, widest_gap_s);
  for (auto i = from + 1; i < to; ++i) {
    const auto gap = moments_[i].t_s - moments_[i - 1].t_s;
    const auto begin = (moments_[i - 1].t_s - start_s) / step_s_ + 0.3;
    const auto end = (moments_[i].t_s - start_s) / step_s_ + 0.7;
    const auto most = static_cast<double>(steps);
    for (auto k = static_cast<std::size_t>(std::clamp(begin, 0.0, most));
         k <= static_cast<std::size_t>(std::clamp(end, 0.0, most)); ++k)
      gap_s[k] = std::min(gap_s[k], gap);
  }
  way_.observe_bend(0, 0, certainty(sigma_accel_mps2));
  way_.observe_bend(steps, 0, certainty(sigma_accel_mps2));
  std::array<double, most_steps> weights;
  for (std::size_t k = 1; k < steps; ++k)
    weights[k - 1] = weight_of_kink(gap_s[k]);
  way_.expect_no_kinks({weights.data(), steps - 1});
}

/// The one knot of a motion shorter than a step.
void longitudinal_fit::roll_out(std::size_t from, std::size_t to) {
  const auto& a = moments_[from];
  const auto& b = moments_[std::min(to, moments_.size() - 1)];
  put({a.way_m, a.speed_mps,
       (b.speed_mps - a.speed_mps) / std::max(b.t_s - a.t_s, slack * step_s_)});
}

void longitudinal_fit::put(motion x) {
  if (done_ > 0)
    x.way_m = std::max(x.way_m, knots_[done_ - 1].way_m);
  knots_[done_++] = x;
}

} // namespace sofof::messages
