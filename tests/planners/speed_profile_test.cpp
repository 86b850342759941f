// A speed plan over way, driven in time.
#include "planners/speed/speed_profile.hpp"

#include "planners/problems/sample_problems.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>

using namespace sofof;
using namespace sofof::planners;
using doctest::Approx;

namespace {

constexpr auto motion_step_s = 0.1;

struct driven {
  std::unique_ptr<velocity_ocp> plan = std::make_unique<velocity_ocp>();
  velocity_problem problem;
  speed_profile motion;
};

driven drive(practice_road& road, double speed_mps, int steps = 80,
             double start_m = 0) {
  driven d;
  d.problem = road.at(0, 0, {0, speed_mps * speed_mps / 2, 0});
  REQUIRE(publishable(d.plan->solve(d.problem, ocp::start::cold).status));
  drive_along(*d.plan, d.problem.ds_m, start_m, 0, motion_step_s, steps,
              d.motion);
  return d;
}

} // namespace

TEST_CASE("the motion drives at the plan's speeds where the plan has them") {
  using enum practice_road::event;
  for (const auto event : {free_flow, slow_leader, stop_line}) {
    practice_road road{event};
    const auto d = drive(road, 11);
    REQUIRE(d.motion.size() > 20);
    CHECK(d.motion[0].s_m == 0);
    CHECK(d.motion[0].speed_mps == Approx(11));
    const auto w = d.plan->w_m2ps2();
    for (const auto& x : d.motion) {
      const auto k = x.s_m / d.problem.ds_m;
      const auto i = static_cast<std::size_t>(k);
      if (x.speed_mps < 0.3 || i + 1 >= w.size())
        continue;
      const auto between = std::lerp(w[i], w[i + 1], k - std::floor(k));
      CHECK(x.speed_mps * x.speed_mps / 2 == Approx(between).epsilon(0.01));
    }
  }
}

TEST_CASE("way, speed and acceleration of a motion fit each other") {
  using enum practice_road::event;
  for (const auto event : {free_flow, slow_leader, stop_line, crossing})
    for (const auto speed : {0.5, 2.0, 8.0, 12.0}) {
      practice_road road{event};
      driven d;
      d.problem = road.at(0, 0, {0, speed * speed / 2, 0});
      if (!publishable(d.plan->solve(d.problem, ocp::start::cold).status))
        continue;
      drive_along(*d.plan, d.problem.ds_m, 0, 0, motion_step_s, 80, d.motion);
      for (std::size_t i = 1; i < d.motion.size(); ++i) {
        const auto &a = d.motion[i - 1], &b = d.motion[i];
        CAPTURE(i);
        CAPTURE(speed);
        REQUIRE(b.s_m >= a.s_m);
        REQUIRE(b.speed_mps >= 0);
        const auto fits_m = motion_step_s * (a.speed_mps + b.speed_mps) / 2
                            + motion_step_s * motion_step_s
                                  * (a.accel_mps2 - b.accel_mps2) / 12;
        if (b.speed_mps > 0) {
          CHECK(std::abs(b.s_m - a.s_m - fits_m) < 1e-3);
          CHECK(std::abs(b.speed_mps - a.speed_mps
                         - motion_step_s * (a.accel_mps2 + b.accel_mps2) / 2)
                < 5e-3);
        }
      }
    }
}

TEST_CASE("a motion ends at rest where its plan ends at rest") {
  practice_road road{practice_road::event::stop_line};
  const auto d = drive(road, 11, 200, 5);
  REQUIRE(d.problem.stop_knot);
  CHECK(d.motion.size() == 201);
  CHECK(d.motion.back().speed_mps == 0);
  CHECK(d.motion.back().accel_mps2 == 0);
  const auto stop_m = 5 + *d.problem.stop_knot * d.problem.ds_m;
  CHECK(d.motion.back().s_m <= stop_m + 1e-6);
  CHECK(d.motion.back().s_m > stop_m - 0.1);
}

TEST_CASE("a motion ends with its plan where that does not rest") {
  practice_road road{practice_road::event::free_flow, 40};
  const auto d = drive(road, 11, 200);
  CHECK(d.motion.size() < 60);
  CHECK(d.motion.back().s_m <= 20 + 1e-6);
  CHECK(d.motion.back().s_m > 20 - 1.5);
}

TEST_CASE("a motion that goes on behind another begins in the middle of a "
          "step") {
  practice_road road{practice_road::event::free_flow};
  driven d;
  d.problem = road.at(0, 0, {0, 0.5, 0});
  REQUIRE(publishable(d.plan->solve(d.problem, ocp::start::cold).status));
  d.motion = {{0, 0.9, 0}, {0.1, 0.95, 0}};
  drive_along(*d.plan, d.problem.ds_m, 0.15, 0.15, motion_step_s, 60, d.motion);
  REQUIRE(d.motion.size() == 61);
  CHECK(d.motion[1].s_m == 0.1); // as it was
  // 0.05 s behind the plan's first knot.
  CHECK(d.motion[2].s_m == Approx(0.15 + 0.05).epsilon(0.01));
  CHECK(d.motion[2].speed_mps == Approx(1).epsilon(0.02));
}
