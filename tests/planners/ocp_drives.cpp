// Speeds planned along whole drives, as a vehicle does: it moves by any
// distance between plans, its horizon ends at stops, leaders come and go.
#include "planners/problems/velocity_ocp.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

using namespace sofof;
using namespace sofof::planners;
using ocp::start;

namespace {

constexpr auto never = std::numeric_limits<double>::infinity();

/// A road with bends, on some of them a leader, a light that is red until some
/// time, or both; all by chance.
class random_street {
public:
  explicit random_street(test::dice& dice)
      : sharpest_1pm_{dice.between(0, 0.06)}, bend_m_{dice.between(20, 60)} {
    if (dice.between(0, 1) < 0.5)
      leader_ = {dice.between(20, 60), dice.between(3, 13)};
    if (dice.between(0, 1) < 0.6)
      light_ = {dice.between(60, 200), dice.between(2, 25)};
  }

  /// @returns the problem of a vehicle at `s_m`; lives until the next call.
  /// Its bounds never demand what the vehicle cannot do: near it they are
  /// those of an easy braking.
  const velocity_problem& at(double s_m, double now_s,
                             const velocity_state& x) {
    constexpr auto horizon_m = 125., step_m = 0.5;
    constexpr auto limit_mps = 13.9, across_mps2 = 2., gentle_mps2 = 1.5;
    constexpr auto ahead_m = 5., ahead_s = 1.2, patience = 1.1;
    p_.start = x;
    p_.stop_knot.reset();
    p_.steps = static_cast<int>(horizon_m / step_m);
    p_.ds_m = step_m;
    if (const auto left = light_ ? light_->s_m - s_m : never;
        red(s_m, now_s, x)) {
      p_.steps =
          std::clamp(static_cast<int>(std::ceil(left / step_m)), 16, p_.steps);
      p_.ds_m = left / p_.steps;
      p_.stop_knot = p_.steps;
    }
    const auto n = static_cast<std::size_t>(p_.steps);
    for (auto* column : {&w_max_, &wanted_, &curvature_, &earliest_, &latest_})
      column->resize(n + 1);
    auto braked = slow_down(x);
    for (std::size_t k = 0; k <= n; ++k) {
      const auto s = s_m + static_cast<double>(k) * p_.ds_m;
      const auto bend = sharpest_1pm_ * std::pow(std::sin(s / bend_m_), 8);
      curvature_[k] = bend;
      w_max_[k] =
          std::min(limit_mps * limit_mps, across_mps2 / (bend + 1e-4)) / 2;
      wanted_[k] = w_max_[k];
      earliest_[k] = -never;
      latest_[k] = never;
      if (leader_ && k > 0) { // who wants no more does not stop to dash
        const auto most = patience * leader_->speed_mps;
        wanted_[k] = std::min(wanted_[k], most * most / 2);
        earliest_[k] =
            (s - leader_->s_m + ahead_m) / leader_->speed_mps + ahead_s - now_s;
      }
      earliest_[k] = std::min(earliest_[k], braked.x.t_s - 0.05);
      w_max_[k] = std::max(w_max_[k], braked.x.w_m2ps2 + 0.05);
      braked.drive(p_.ds_m);
    }
    if (p_.stop_knot)
      w_max_[n] = 0;
    for (std::size_t k = n + 1; k-- > 0;) {
      const auto after = k < n ? wanted_[k + 1] + p_.ds_m * gentle_mps2 : never;
      wanted_[k] = std::max(0.125, std::min({wanted_[k], w_max_[k], after}));
    }
    p_.w_max_m2ps2 = w_max_;
    p_.wanted_m2ps2 = wanted_;
    p_.curvature_1pm = curvature_;
    p_.earliest_s = earliest_;
    p_.latest_s = latest_;
    p_.limits = {.accel_min_mps2 = -4,
                 .jerk_max_mps3 = 4,
                 .total_max_mps2 = 5,
                 .total_from = 30};
    return p_;
  }

private:
  struct place {
    double s_m, speed_mps;
  };
  struct light {
    double s_m, green_s;
  };

  /// A vehicle that brakes easily.
  struct slow_down {
    explicit slow_down(const velocity_state& from) : x{from} {}

    void drive(double ds_m) {
      constexpr auto easy_mps2 = -1.2, easy_mps3 = 0.8;
      const auto v = ocp::speed_of(x.w_m2ps2);
      x.accel_mps2 = std::max(easy_mps2, x.accel_mps2 - ds_m * easy_mps3 / v);
      x.w_m2ps2 = std::max(0., x.w_m2ps2 + ds_m * x.accel_mps2);
      x.t_s += 2 * ds_m / (v + ocp::speed_of(x.w_m2ps2));
    }

    velocity_state x;
  };

  /// Whether the vehicle has to stop: it does once it has begun to, and if it
  /// easily can.
  bool red(double s_m, double now_s, const velocity_state& x) {
    constexpr auto sight_m = 124.;
    const auto left = light_ ? light_->s_m - s_m : never;
    const auto easily = x.w_m2ps2 / 1.5 + 1.5 * ocp::speed_of(x.w_m2ps2) < left;
    stops_ = light_ && left < sight_m && now_s < light_->green_s
             && (stops_ || easily);
    return stops_;
  }

  double sharpest_1pm_, bend_m_;
  std::optional<place> leader_;
  std::optional<light> light_;
  bool stops_ = false;
  std::vector<double> w_max_, wanted_, curvature_, earliest_, latest_;
  velocity_problem p_;
};

/// @returns the plan's state after some time, and how far it is by then.
std::pair<velocity_state, double> after(const velocity_ocp& plan, double ds_m,
                                        double time_s) {
  const auto t = plan.t_s();
  std::size_t k = 0;
  while (k + 2 < t.size() && t[k + 1] < time_s)
    ++k;
  const auto share = std::min(1., (time_s - t[k]) / (t[k + 1] - t[k]));
  const auto between = [=](std::span<const double> x) {
    return (1 - share) * x[k] + share * x[k + 1];
  };
  constexpr auto least_w = 0.125; // half a metre per second
  return {{0, std::max(least_w, between(plan.w_m2ps2())),
           between(plan.accel_mps2())},
          (static_cast<double>(k) + share) * ds_m};
}

} // namespace

TEST_CASE("in traffic there is always a plan, mostly within a few steps") {
  constexpr auto drives = 60, cycles = 120;
  const auto solver = std::make_unique<velocity_ocp>();
  test::dice dice{2};
  auto steps = 0, most = 0, plans = 0;
  for (int drive = 0; drive < drives; ++drive) {
    CAPTURE(drive);
    *solver = {};
    random_street road{dice};
    velocity_state x{0, dice.between(0.2, 60), 0};
    auto s_m = 0., now_s = 0., moved_m = 0.;
    for (int cycle = 0; cycle < cycles; ++cycle) {
      CAPTURE(cycle);
      const auto& problem = road.at(s_m, now_s, x);
      if (problem.stop_knot && problem.ds_m * problem.steps < 1)
        break; // it is there
      solver->carry_over(moved_m, problem.ds_m, problem.steps);
      const auto report = solver->solve(problem, start::warm);
      REQUIRE(publishable(report.status));
      steps += report.iterations;
      most = std::max(most, report.iterations);
      ++plans;
      const auto dt_s = dice.between(0.05, 0.4);
      std::tie(x, moved_m) = after(*solver, problem.ds_m, dt_s);
      s_m += moved_m;
      now_s += dt_s;
    }
  }
  MESSAGE(plans << " plans, Newton steps: " << steps << ", at most " << most);
  CHECK(steps < 5 * plans);
}
