// A planning cycle takes nothing from the heap.
#include "planners/problems/sample_problems.hpp"
#include "planners/scene/object_tracker.hpp"
#include "planners/scene/scene_interpreter.hpp"
#include "planners/trajectory/spatial_planner.hpp"
#include "tests/planners/onlooker.hpp"
#include "tests/planners/test_drive.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/toy_streets.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <memory>
#include <utility>
#include <vector>

using namespace sofof;
using namespace sofof::planners;
using namespace sofof::world;

TEST_CASE("the counter counts") {
  const auto before = test::allocations;
  const auto something = std::make_unique<path_ocp>();
  CHECK(something != nullptr);
  CHECK(test::allocations > before);
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

TEST_CASE("a round in traffic takes nothing from the heap but at its start") {
  using namespace std::chrono_literals;
  const auto way = test::oval({{0, 13.9}});
  spatial_planner planner{
      std::make_shared<route_profile>(way, comfort_limits{}),
      {},
      {.candidates = 16, .alternations = 2}};
  trajectory plan, before;
  planning_input x;
  auto replaced = 0;
  long taken = 0;
  for (auto cycle = 0; cycle < 1200; ++cycle) {
    // In turns: alone, behind another, past one that stands, and after one
    // that crosses.
    auto& seen = x.others;
    seen.at = x.at;
    seen.lead.reset();
    seen.beside.clear();
    seen.crossings.clear();
    const auto scene = cycle / 50 % 4;
    if (scene == 1)
      seen.lead = lead_vehicle{2, x.s_m + 25, 9, 0};
    if (scene == 2)
      seen.beside.push_back({x.s_m + 40, x.s_m + 45, -2.5, -1.2, 0});
    if (scene == 3)
      seen.crossings.push_back({x.s_m + 60, x.s_m + 66, 2, 7});
    std::swap(plan, before);
    const auto had = test::allocations;
    const auto report =
        planner.plan(x.at, x, before.empty() ? nullptr : &before, plan);
    taken = cycle < 200 ? 0 : taken + test::allocations - had;
    replaced += report.origin != plan_origin::planned;
    x.at += 50ms;
    const auto p = plan.at(x.at);
    x.s_m = p.s_m;
    x.speed_mps = p.speed_mps;
    x.accel_mps2 = p.accel_mps2;
  }
  CHECK(taken == 0);
  CHECK(replaced == 0);
  CHECK(x.s_m > 300);
}

TEST_CASE(
    "following bodies takes nothing from the heap, once there have been as "
    "many") {
  using namespace std::chrono_literals;
  object_tracker model;
  std::vector<perceived_object> queue;
  for (auto i = 0; i < 40; ++i)
    queue.push_back({{8.0 * i, 0}, 0, 0, 0, 5.1, 1.89});
  const auto follow = [&](time_point from, time_point to) {
    for (auto t = from; t < to; t += 100ms) {
      model.update(t, queue);
      model.on_report(t, 3, queue[2]);
      model.update(t - 200ms, queue);
    }
  };
  follow(time_point{1s}, time_point{1200ms});
  const auto before = test::allocations;
  follow(time_point{1200ms}, time_point{3s});
  CHECK(test::allocations == before);
  CHECK(model.tracks().size() == 40);
}

TEST_CASE("looking round takes nothing from the heap, once as much was seen") {
  const auto map = toy::cross_roads();
  scene_params params;
  params.judges_crossings = true;
  scene_interpreter eyes{test::look_at(map, toy::make_route(map, {4, 0, 2})),
                         params};
  object_tracker model;
  std::vector<perceived_object> all;
  for (auto i = 0; i < 12; ++i) {
    all.push_back({{-8.0 * i, -1.75}, 0, 10, 0, 5.1, 1.89});
    all.push_back({{1.75, -90 + 8.0 * i}, 1.57, 10, 0, 5.1, 1.89});
  }
  model.update(time_point{}, all);
  driving_scene seen;
  const auto drive = [&] {
    for (auto s_m = 20.0; s_m < 100; s_m += 5)
      eyes.describe(time_point{}, {{}, s_m}, model.tracks(), seen);
  };
  drive();
  const auto before = test::allocations;
  drive();
  CHECK(test::allocations == before);
  CHECK(seen.crossings.size() > 10);
}
