// How long a way takes a car that is alone on it.
#include "planners/speed/lone_drive.hpp"

#include "planners/problems/velocity_ocp.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

namespace sofof::planners {
namespace {

constexpr double lone_step_m = 1;
/// What lies beyond this does not matter to a car.
constexpr double look_ahead_m = 200;
constexpr double lone_rests_below_mps = 0.1;
constexpr double lone_least_wanted_m2ps2 = 0.125;
/// A planner stops so far before an end.
constexpr double lone_line_gap_m = 0.3;
/// Places at the envelope are found round by round.
constexpr int most_rounds = 12;
constexpr double excess_m2ps2 = 1e-3;

/// v²/2 at equal steps of a way; the first is given.
struct energies {
  std::vector<double> allowed, w;
  std::vector<bool> is_fixed;       // at what is allowed
  std::vector<double> above, right; // room of the sweep

  explicit energies(std::vector<double> most, double first)
      : allowed{std::move(most)}, w(allowed.size(), first),
        is_fixed(allowed.size()), above(allowed.size()), right(allowed.size()) {
  }

  /// Minimises the cost, with what is fixed: one sweep up, one back.
  void solve() {
    assert(w.size() >= 2 && allowed.size() == w.size());
    constexpr velocity_weights weigh;
    const auto last = w.size() - 1;
    const auto tie = 2 * weigh.accel / lone_step_m;
    above[0] = 0;
    right[0] = w[0];
    for (std::size_t k = 1; k <= last; ++k) {
      if (is_fixed[k]) {
        above[k] = 0;
        right[k] = allowed[k];
        continue;
      }
      const auto wanted = std::max(allowed[k], lone_least_wanted_m2ps2);
      const auto pull = weigh.speed * lone_step_m / wanted;
      const auto next = k < last ? tie : 0.0;
      const auto pivot = pull + next + tie * (1 - above[k - 1]);
      above[k] = next / pivot;
      right[k] = (pull * wanted + tie * right[k - 1]) / pivot;
    }
    assert(std::isfinite(right[last]));
    w[last] = right[last];
    for (auto k = last; k-- > 1;)
      w[k] = right[k] + above[k] * w[k + 1];
  }

  void solve_within() {
    assert(is_fixed.size() == w.size());
    assert(std::ranges::all_of(allowed, [](double x) { return x >= 0; }));
    for (auto round = 0; round < most_rounds; ++round) {
      solve();
      auto done = true;
      for (std::size_t k = 1; k < w.size(); ++k)
        if (!is_fixed[k] && w[k] > allowed[k] + excess_m2ps2) {
          is_fixed[k] = true;
          done = false;
        }
      if (done)
        break;
    }
  }
};

/// @returns what it costs that an acceleration builds up from rest, or fades
/// out into it: every speed is reached so much later, or left so much sooner.
double built_up_s(double accel_mps2, double jerk_mps3) {
  return accel_mps2 / jerk_mps3 / 2;
}

} // namespace

double lone_drive_s(const route_profile& road, const comfort_limits& style,
                    double from_m, double speed_mps, double to_m) {
  assert(speed_mps >= 0 && to_m >= from_m && std::isfinite(to_m));
  const auto& way = road.line.way();
  const auto end_m = way.length_m() - style.front_m - lone_line_gap_m;
  const auto ends = !way.closed() && to_m + look_ahead_m > end_m;
  const auto last_m =
      ends ? std::max(end_m, from_m + lone_step_m) : to_m + look_ahead_m;
  const auto steps =
      static_cast<std::size_t>(std::ceil((last_m - from_m) / lone_step_m));
  std::vector<double> allowed(steps + 1);
  for (std::size_t k = 0; k <= steps; ++k) {
    const auto limit =
        road.envelope.limit_mps(from_m + static_cast<double>(k) * lone_step_m);
    allowed[k] = limit * limit / 2;
  }
  if (ends)
    allowed.back() = 0;
  const auto first = std::min(speed_mps * speed_mps / 2, allowed.front());
  assert(first >= 0 && steps >= 1);
  energies drive{std::move(allowed), first};
  drive.is_fixed.back() = ends;
  drive.solve_within();

  auto takes_s = speed_mps < lone_rests_below_mps
                     ? built_up_s(style.max_accel_mps2, style.max_jerk_mps3)
                     : 0.0;
  const auto speed = [&](std::size_t k) {
    return std::sqrt(2 * std::max(0.0, drive.w[k]));
  };
  for (std::size_t k = 0; k < steps; ++k) {
    const auto way_m = std::min(
        lone_step_m, to_m - from_m - static_cast<double>(k) * lone_step_m);
    if (way_m <= 0)
      break;
    takes_s +=
        way_m / std::max((speed(k) + speed(k + 1)) / 2, lone_rests_below_mps);
  }
  if (ends && to_m >= end_m - lone_step_m)
    takes_s += built_up_s(style.comfort_decel_mps2, style.max_jerk_mps3);
  return takes_s;
}

} // namespace sofof::planners
