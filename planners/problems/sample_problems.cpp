// Roads as sums of sines; obstacles at fixed places.
#include "planners/problems/sample_problems.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sofof::planners {

namespace {

constexpr auto no_time = std::numeric_limits<double>::infinity();

} // namespace

slalom::slalom(int steps, double ds_m, double width_m) : width_m_{width_m} {
  assert(steps >= 1 && steps <= ocp::most_steps);
  assert(ds_m > 0 && width_m > 0);
  const auto knots = static_cast<std::size_t>(steps) + 1;
  curvature_.resize(2 * knots - 1);
  wanted_.assign(knots, 0);
  for (std::size_t j = 0; j < discs; ++j) {
    lo_[j].resize(knots);
    hi_[j].resize(knots);
    corridor_[j] = {1.4 * static_cast<double>(j), lo_[j], hi_[j]};
  }
  problem_.steps = steps;
  problem_.ds_m = ds_m;
  problem_.curvature_1pm = curvature_;
  problem_.wanted_m = wanted_;
  problem_.discs = corridor_;
  problem_.curvature_max_1pm = 0.05;
  problem_.rate_max_1pm2 = 0.01;
}

double slalom::curvature_1pm(double s_m) const {
  return 0.012 * std::sin(s_m / 25) + 0.006 * std::sin(s_m / 9);
}

const path_problem& slalom::at(int knot, const path_state& start) {
  constexpr auto spacing_m = 40., length_m = 8., share = 0.55;
  constexpr auto near_knots = 6;
  constexpr auto near_m = 0.2; // what is near may be a little narrower
  const auto ds = problem_.ds_m, begin = knot * ds;
  assert(curvature_.size() == 2 * static_cast<std::size_t>(problem_.steps) + 1);
  for (std::size_t i = 0; i < curvature_.size(); ++i)
    curvature_[i] = curvature_1pm(begin + static_cast<double>(i) * ds / 2);
  for (int k = 0; k <= problem_.steps; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const auto relief = near_m * std::max(0, near_knots - k) / near_knots;
    for (std::size_t j = 0; j < discs; ++j) {
      const auto s = begin + k * ds + corridor_[j].ahead_m;
      const auto which = std::floor(s / spacing_m);
      const auto taken =
          s - which * spacing_m > spacing_m - length_m ? share * width_m_ : 0;
      const auto left = std::fmod(which, 2) == 0;
      lo_[j][at] = -width_m_ / 2 + (left ? 0 : taken) - relief;
      hi_[j][at] = width_m_ / 2 - (left ? taken : 0) + relief;
    }
  }
  problem_.start = start;
  return problem_;
}

practice_road::practice_road(event what, int steps, double ds_m) : what_{what} {
  assert(steps >= 1 && steps <= ocp::most_steps && ds_m > 0);
  const auto knots = static_cast<std::size_t>(steps) + 1;
  for (auto* column : {&w_max_, &wanted_, &curvature_, &earliest_, &latest_})
    column->resize(knots);
  problem_.steps = steps;
  problem_.ds_m = ds_m;
  problem_.w_max_m2ps2 = w_max_;
  problem_.wanted_m2ps2 = wanted_;
  problem_.curvature_1pm = curvature_;
  problem_.earliest_s = earliest_;
  problem_.latest_s = latest_;
}

const velocity_problem& practice_road::at(int knot, double now_s,
                                          const velocity_state& start) {
  constexpr auto limit_mps = 13.9, across_mps2 = 2., least_w = 0.5;
  constexpr auto gentle_mps2 = 1.5;
  constexpr auto leader_mps = 6., leader_m = 40., gap_m = 5., gap_s = 1.2;
  constexpr auto stop_m = 70.;
  constexpr auto crossing_m = 60., crossing_s = 12.;
  const auto n = problem_.steps;
  const auto ds = problem_.ds_m;
  const auto place = [&](double s) { // of a place on the road, in knots
    return static_cast<int>(std::lround(s / ds)) - knot;
  };
  for (int k = 0; k <= n; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const auto s = (knot + k) * ds;
    const auto bend = std::pow(std::sin(s / 45), 8);
    curvature_[at] = 0.03 * bend;
    const auto v2 =
        std::min(limit_mps * limit_mps, across_mps2 / (0.03 * bend + 1e-4));
    w_max_[at] = v2 / 2;
    earliest_[at] = -no_time;
    latest_[at] = no_time;
    if (what_ == event::slow_leader && k >= 14)
      earliest_[at] = (s - leader_m + gap_m) / leader_mps + gap_s - now_s;
  }
  assert(w_max_.size() == static_cast<std::size_t>(n) + 1);
  problem_.stop_knot.reset();
  if (const auto k = place(stop_m); what_ == event::stop_line && k <= n)
    problem_.stop_knot = std::max(k, 1);
  if (const auto k = place(crossing_m);
      what_ == event::crossing && k >= 1 && k <= n)
    earliest_[static_cast<std::size_t>(k)] = crossing_s - now_s;
  const auto stop = problem_.stop_knot.value_or(n + 1);
  for (int k = n; k >= 0; --k) {
    const auto at = static_cast<std::size_t>(k);
    if (k >= stop)
      w_max_[at] = 0;
    assert(w_max_[at] >= 0);
    const auto after = k < n ? wanted_[at + 1] + ds * gentle_mps2 : no_time;
    wanted_[at] = std::max(least_w, std::min(w_max_[at], after));
    // Near the car the limit is one that it can still keep.
    const auto braking = start.w_m2ps2 + 0.05 - 1.2 * std::max(0, k - 4) * ds;
    if (k < stop)
      w_max_[at] = std::max(w_max_[at], std::max(0., braking));
  }
  problem_.start = start;
  return problem_;
}

} // namespace sofof::planners
