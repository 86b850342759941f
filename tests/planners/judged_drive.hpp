// A car that judges the plans that it is sent, for tests of the judge.
#pragma once

#include "planners/judges/plan_judge.hpp"
#include "tests/support/toy_streets.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sofof::test {

using namespace planners;
using namespace world;
using namespace std::chrono_literals;

/// A car on a straight street with a limit of 10 m/s, 200 m along it, and a
/// provider that sends plans every 50 ms. The car follows each of them.
struct judged_drive {
  route_ptr way = street();
  time_point now{10s};
  double s_m = 200, d_m = 0, speed_mps = 10;
  perception seen;
  duration own_age{}; ///< Of what the car knows of itself.
  bool granted = true;
  std::uint64_t fingerprint = 0;
  trajectory in_use;
  /// Of the own planner's plans, up to 10 m/s; it has none without.
  std::optional<double> own_accel_mps2;
  plan_judge judge;

  static route_ptr street(bool closed = false) {
    const road_map map{
        "street", {}, {toy::straight("street", {0, 0}, {2000, 0})}};
    return map.make_route("street", std::vector<std::string>{"street"}, closed);
  }

  /// From where the car is.
  /// @param slope  How far it goes to the left for each metre.
  /// @param most_mps  It drives no faster.
  trajectory plan(double accel_mps2, double slope = 0,
                  double most_mps = 100) const {
    trajectory x;
    x.start = now;
    auto s = s_m, v = speed_mps;
    for (int k = 0; k <= 60; ++k) {
      const auto stays = accel_mps2 < 0 ? v <= 0 : v >= most_mps;
      const auto a = stays ? 0 : accel_mps2;
      x.points.push_back(
          {0.1 * k, s, {s, d_m + slope * (s - s_m)}, slope, 0, v, a});
      const auto next = std::max(0.0, v + 0.1 * a);
      s += 0.05 * (v + next);
      v = next;
    }
    return x;
  }

  plan_verdict ask(const trajectory& x) {
    seen.at = now;
    judged_plan asked{*way,
                      x,
                      in_use.empty() ? nullptr : &in_use,
                      {now - own_age, {s_m, d_m}, 0, speed_mps, 0, 0},
                      s_m,
                      seen,
                      granted,
                      now,
                      fingerprint};
    const auto own =
        own_accel_mps2 ? plan(*own_accel_mps2, 0, 10) : trajectory{};
    if (judge.wants_own_plan(asked))
      asked.own_plan = &own;
    return judge.judge(asked);
  }

  /// Drives along a plan for a while.
  void follow(const trajectory& x, duration d = 50ms) {
    in_use = x;
    const auto p = x.at(now + d);
    now += d;
    s_m = p.s_m;
    d_m = p.at.y_m;
    speed_mps = p.speed_mps;
  }

  /// Sends such plans until one is refused, for at most so long.
  /// @returns the check; empty for none.
  template <class Make>
  std::string refused_of(Make make, duration d) {
    const auto end = now + d;
    while (now < end) {
      const auto x = make();
      const auto verdict = ask(x);
      if (verdict.refused)
        return std::string{verdict.refused->check};
      if (verdict.usable)
        follow(x);
      else
        now += 50ms;
    }
    return {};
  }
  std::string refused_within(duration d, double accel_mps2, double slope = 0) {
    return refused_of([&] { return plan(accel_mps2, slope); }, d);
  }

  void see_car(double s, double d, double heading_rad, double speed,
               double accel = 0) {
    seen.objects.push_back({{s, d}, heading_rad, speed, accel, 4.5, 1.8});
  }
};

} // namespace sofof::test
