// A solve takes nothing from the heap.
#include "planners/practice.hpp"
#include "tests/planners/test_drive.hpp"
#include "tests/support/allocations.hpp"

#include <doctest/doctest.h>

#include <memory>

using namespace sofof;

TEST_CASE("the counter counts") {
  const auto before = test::allocations;
  const auto something = std::make_unique<path_ocp>();
  CHECK(something != nullptr);
  CHECK(test::allocations > before);
}

TEST_CASE("a planning cycle takes nothing from the heap after the first few, "
          "whatever happens on the road") {
  const auto way = test::oval({{0, 13.9}});
  spatial_params params;
  params.candidates = 4;
  const auto planner = test::optimiser(way, params);
  trajectory plan, before;
  plan.points.reserve(61);
  before.points.reserve(61);
  planning_input x;
  x.s_m = 10;
  x.speed_mps = 8;
  x.others.lead = lead_vehicle{1, 0, 8, 0};
  x.others.beside = {{0, 0, -1.9, -0.9, 0}, {0, 0, -2.0, -0.9, -3}};
  x.others.crossings = {{0, 0, 0, 0, true}, {0, 0, 0, 0, true}};
  const auto refuse = [](int) noexcept { return false; };
  const auto cycle = [&](int n) {
    x.at = x.others.at = time_point{n * from_seconds(0.05)};
    if (n > 0) {
      const auto own = seen_from(*way, plan.at(x.at));
      x.s_m = own.s_m;
      x.d_m = own.d_m;
      x.heading_error_rad = own.heading_error_rad;
      x.curvature_1pm = own.curvature_1pm;
      x.speed_mps = own.speed_mps;
      x.accel_mps2 = own.accel_mps2;
    }
    const auto event = n / 20 % 4;
    x.others.lead->rear_s_m = x.s_m + (event == 1 ? 14 : 50);
    for (auto& body : x.others.beside) {
      body.from_m = x.s_m + 30;
      body.to_m = body.from_m + 4;
    }
    for (auto& user : x.others.crossings) {
      user.from_m = x.s_m + (event == 2 ? 25 : 60);
      user.to_m = user.from_m + 4;
      user.enter_s = 2;
      user.leave_s = 5;
    }
    const auto none = n % 10 == 9;
    std::swap(plan, before);
    planner->plan(x.at, x, n == 0 ? nullptr : &before, plan,
                  none ? ocp::budget{refuse} : ocp::budget{});
  };
  for (auto n = 0; n < 100; ++n)
    cycle(n);
  for (auto n = 100; n < 300; ++n) {
    const auto counted = test::allocations;
    cycle(n);
    CAPTURE(n);
    CHECK(test::allocations == counted);
  }
}

TEST_CASE("planning takes nothing from the heap") {
  slalom road;
  practice_road street{practice_road::event::slow_leader};
  const auto path = std::make_unique<path_ocp>();
  const auto velocity = std::make_unique<velocity_ocp>();
  for (const auto how : {ocp::start::cold, ocp::start::warm}) {
    const auto& where = road.at(0, {.d_m = 0.2});
    const auto& when = street.at(0, 0, {0, 60, 0});
    const auto before = test::allocations;
    path->shift(1);
    velocity->shift(1);
    const auto a = path->solve(where, how);
    const auto b = velocity->solve(when, how);
    CHECK(test::allocations == before);
    CHECK(publishable(a.status));
    CHECK(publishable(b.status));
  }
}
