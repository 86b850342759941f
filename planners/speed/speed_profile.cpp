// From plans over way to motion over time.
#include "planners/speed/speed_profile.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {
namespace {

/// Slower than this a braking car comes to rest.
constexpr double resting_mps = 0.05;
constexpr int newton_steps = 2;
constexpr double short_s = 1e-9;

/// 1 + z/a (1 + z/b (1 + z/c)), without a division.
[[gnu::always_inline]] inline double series(double z, double a, double b,
                                            double c) {
  return 1 + 1 / a * z * (1 + 1 / b * z * (1 + 1 / c * z));
}

/// Within one interval: x'' = a + u x from x = 0.
struct interval {
  double speed_mps, accel_mps2, u_1ps2;

  /// After `t` seconds, |u| t² small.
  lane_motion at(double t) const {
    const auto z = u_1ps2 * t * t;
    const auto even = series(z, 2, 12, 30);    // cosh
    const auto odd = t * series(z, 6, 20, 42); // sinh
    const auto twice = t * t / 2 * series(z, 12, 30, 56);
    const auto x = speed_mps * odd + accel_mps2 * twice;
    return {x, speed_mps * even + accel_mps2 * odd, accel_mps2 + u_1ps2 * x};
  }

  /// When x is reached, between 0 and `most`, where it is passed.
  /// @param far  The way after `most`.
  double when(double x, double most, double far) const {
    assert(most > 0 && !(far < x));
    auto t = most * x / far;
    for (int i = 0; i < newton_steps; ++i) {
      const auto y = at(t);
      t = std::clamp(t + (x - y.s_m) / std::max(y.speed_mps, resting_mps / 2),
                     0.0, most);
    }
    assert(!(t < 0 || t > most));
    return t;
  }
};

} // namespace

void drive_along(const velocity_ocp& plan, double ds_m, double start_m,
                 double start_s, double step_s, int steps, speed_profile& out) {
  const auto w = plan.w_m2ps2(), a = plan.accel_mps2(), u = plan.u_1ps2();
  const auto intervals = u.size();
  assert(w.size() == intervals + 1 && a.size() == intervals + 1);
  assert(ds_m > 0 && step_s > 0 && start_s >= 0 && steps >= 0);
  std::size_t k = 0;
  // The state now, `x` metres behind knot k, `t` seconds from the beginning.
  auto now = lane_motion{0, std::sqrt(2 * std::max(0.0, w[0])), a[0]};
  auto t = start_s;
  while (static_cast<int>(out.size()) <= steps) {
    const auto until = static_cast<double>(out.size()) * step_s;
    auto rests = false;
    while (k < intervals && !rests && until - t > short_s) {
      const interval here{now.speed_mps, now.accel_mps2, u[k]};
      const auto dt = std::min(step_s, until - t);
      const auto then = here.at(dt);
      const auto left_m = ds_m - now.s_m;
      assert(!(left_m < 0) && dt > 0);
      if (then.speed_mps < resting_mps && then.accel_mps2 <= 0) {
        rests = true;
      } else if (then.s_m < left_m) {
        now = {now.s_m + then.s_m, then.speed_mps, then.accel_mps2};
        t += dt;
      } else {
        t += here.when(left_m, dt, then.s_m);
        ++k; // and begin anew: errors do not add up
        now = {0, std::sqrt(2 * std::max(0.0, w[k])), a[k]};
        rests = now.speed_mps < resting_mps && now.accel_mps2 <= 0;
      }
    }
    const auto way = start_m + static_cast<double>(k) * ds_m + now.s_m;
    if (rests) {
      out.resize(static_cast<std::size_t>(steps) + 1, {way, 0, 0});
      return;
    }
    if (k == intervals)
      return;
    assert(out.empty() || !(way < out.back().s_m)); // never back
    out.push_back({way, now.speed_mps, now.accel_mps2});
  }
}

} // namespace sofof::planners
