// A warm start that moves by any distance, changes grids, and changes hands.
#include "planners/planner_memory.hpp"
#include "planners/practice.hpp"
#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

using namespace sofof;
using enum ocp::solve_status;
using ocp::start;
using event = practice_road::event;

namespace {

// Workspaces are too large for a stack.
std::unique_ptr<path_ocp> path_solver() {
  return std::make_unique<path_ocp>();
}
std::unique_ptr<velocity_ocp> speed_solver() {
  return std::make_unique<velocity_ocp>();
}

struct grid {
  int steps;
  double ds_m;
};

int knot(const grid& g, int metre) {
  return static_cast<int>(std::lround(metre / g.ds_m));
}

/// A velocity solver that has a plan for the practice road.
std::unique_ptr<velocity_ocp> driving(event what, int steps, double ds_m) {
  auto solver = speed_solver();
  practice_road road{what, steps, ds_m};
  REQUIRE(solver->solve(road.at(0, 0, {0, 60, 0}), start::cold).status
          == converged);
  return solver;
}

/// A path solver that has a plan for the slalom.
std::unique_ptr<path_ocp> steering(int steps, double ds_m) {
  auto solver = path_solver();
  slalom road{steps, ds_m};
  REQUIRE(solver->solve(road.at(0, {}), start::cold).status == converged);
  return solver;
}

velocity_state state_at(const velocity_ocp& s, std::size_t k) {
  return {0, s.w_m2ps2()[k], s.accel_mps2()[k]};
}

path_state state_at(const path_ocp& s, std::size_t k) {
  return {s.offset_m()[k], s.heading_rad()[k], s.curvature_1pm()[k]};
}

} // namespace

TEST_CASE("carried over by whole knots, a plan keeps its numbers") {
  const auto solver = driving(event::slow_leader, 160, 0.5);
  const std::vector<double> w(solver->w_m2ps2().begin(),
                              solver->w_m2ps2().end());
  const std::vector<double> u(solver->u_1ps2().begin(), solver->u_1ps2().end());
  solver->carry_over(3.5, 0.5, 160);
  for (std::size_t k = 0; k + 7 < w.size(); ++k)
    CHECK(solver->w_m2ps2()[k] == w[k + 7]);
  for (std::size_t k = 0; k + 7 < u.size(); ++k)
    CHECK(solver->u_1ps2()[k] == u[k + 7]);
}

TEST_CASE(
    "carried over by a share of a knot, a plan says the same of the road") {
  const auto solver = driving(event::free_flow, 160, 0.5);
  const std::vector<double> w(solver->w_m2ps2().begin(),
                              solver->w_m2ps2().end());
  constexpr auto by = 10.3, ds = 0.7;
  solver->carry_over(by, ds, 99);
  REQUIRE(solver->w_m2ps2().size() == 100);
  for (std::size_t k = 0; k < 100; ++k) {
    const auto at = (by + static_cast<double>(k) * ds) / 0.5;
    const auto i = static_cast<std::size_t>(at);
    const auto share = at - static_cast<double>(i);
    CHECK(solver->w_m2ps2()[k]
          == test::near((1 - share) * w[i] + share * w[i + 1], 1e-12));
  }
}

TEST_CASE("beyond its end a plan is thought to go on as it ended") {
  const auto solver = steering(80, 1);
  const auto end = state_at(*solver, 80);
  solver->carry_over(20, 0.5, 250);
  REQUIRE(solver->offset_m().size() == 251);
  CHECK(solver->offset_m()[200] == end.d_m);
  CHECK(solver->curvature_1pm()[120] == end.curvature_1pm);
  CHECK(solver->rate_1pm2()[249] == 0);
  // And far beyond it.
  solver->carry_over(1e18, 0.5, 250);
  CHECK(solver->offset_m()[0] == end.d_m);
}

TEST_CASE("a horizon that is cut to end where the car stops, and back") {
  // The stop line is 70 m ahead; the road then ends there, in steps that fit.
  const auto solver = driving(event::stop_line, 250, 0.5);
  constexpr auto by = 10.2;
  const auto k = static_cast<std::size_t>(by / 0.5);
  const auto now = state_at(*solver, k);
  practice_road to_the_line{event::free_flow, 120, (70 - by) / 120};
  auto problem = to_the_line.at(0, 0, now);
  std::vector<double> w_max(problem.w_max_m2ps2.begin(),
                            problem.w_max_m2ps2.end());
  w_max.back() = 0;
  problem.w_max_m2ps2 = w_max;
  problem.stop_knot = 120;
  const auto cold = speed_solver()->solve(problem, start::cold);
  REQUIRE(cold.status == converged);
  solver->carry_over(by, problem.ds_m, 120);
  const auto warm = solver->solve(problem, start::warm);
  CHECK(warm.status == converged);
  CHECK(warm.cost == test::near(cold.cost, 1e-3));
  CHECK(warm.iterations < cold.iterations);

  // Green: what the plan knew of the stop must not keep the car there.
  practice_road open{event::free_flow, 250, 0.5};
  const auto& free = open.at(0, 0, state_at(*solver, 100));
  const auto without = speed_solver()->solve(free, start::cold);
  solver->carry_over(100 * problem.ds_m, 0.5, 250);
  const auto green = solver->solve(free, start::warm);
  CHECK(green.status == converged);
  CHECK(green.cost == test::near(without.cost, 1e-3));
}

TEST_CASE(
    "a warm start on a grid that it was not carried over to is a cold one") {
  slalom coarse{80, 1};
  const auto solver = steering(80, 0.5);
  const auto warm = solver->solve(coarse.at(0, {}), start::warm);
  const auto cold = path_solver()->solve(coarse.at(0, {}), start::cold);
  CHECK(warm.iterations == cold.iterations);
  CHECK(warm.cost == cold.cost);
}

TEST_CASE("a velocity planner goes on from the plan of one with another grid") {
  constexpr grid fine{250, 0.5}, coarse{80, 1};
  for (const auto what : {event::free_flow, event::stop_line})
    for (const auto& [from, to] : {std::pair{fine, coarse}, {coarse, fine}}) {
      CAPTURE(static_cast<int>(what));
      CAPTURE(from.steps);
      practice_road theirs{what, from.steps, from.ds_m};
      practice_road ours{what, to.steps, to.ds_m};
      const auto first = speed_solver(), second = speed_solver();
      const auto a_metre = static_cast<std::size_t>(1 / from.ds_m);
      velocity_state x{0, 60, 0};
      auto now_s = 0.;
      auto warm = 0, cold = 0;
      for (int metre = 0; metre < 40; ++metre) {
        first->carry_over(metre > 0 ? 1 : 0, from.ds_m, from.steps);
        first->solve(theirs.at(knot(from, metre), now_s, x), start::warm);
        now_s += first->t_s()[a_metre];
        x = state_at(*first, a_metre);
        const auto& problem = ours.at(knot(to, metre + 1), now_s, x);
        const auto fresh = second->solve(problem, start::cold);
        REQUIRE(second->adopt(first->warm_start()));
        second->carry_over(1, to.ds_m, to.steps);
        const auto taken = second->solve(problem, start::warm);
        CHECK(taken.status == converged);
        CHECK(taken.cost == test::near(fresh.cost, 1e-3));
        warm += taken.iterations;
        cold += fresh.iterations;
      }
      CHECK(2 * warm < cold);
    }
}

TEST_CASE("a path planner goes on from the plan of one that sees further") {
  constexpr grid far{250, 0.5}, near{160, 0.5};
  slalom theirs{far.steps, far.ds_m}, ours{near.steps, near.ds_m};
  const auto first = path_solver(), second = path_solver();
  path_state x;
  auto warm = 0, cold = 0;
  for (int metre = 0; metre < 40; ++metre) {
    first->carry_over(metre > 0 ? 1 : 0, far.ds_m, far.steps);
    first->solve(theirs.at(knot(far, metre), x), start::warm);
    x = state_at(*first, 2);
    const auto& problem = ours.at(knot(near, metre + 1), x);
    const auto fresh = second->solve(problem, start::cold);
    REQUIRE(second->adopt(first->warm_start()));
    second->carry_over(1, near.ds_m, near.steps);
    const auto taken = second->solve(problem, start::warm);
    CHECK(taken.status == converged);
    CHECK(taken.cost == test::near(fresh.cost, 1e-3));
    warm += taken.iterations;
    cold += fresh.iterations;
  }
  CHECK(2 * warm < cold);
}

TEST_CASE("a path planner can go on from one with other steps") {
  constexpr grid fine{250, 0.5}, coarse{80, 1};
  for (const auto& [from, to] : {std::pair{fine, coarse}, {coarse, fine}}) {
    const auto first = steering(from.steps, from.ds_m);
    const auto x = state_at(*first, static_cast<std::size_t>(2 / from.ds_m));
    slalom ours{to.steps, to.ds_m};
    const auto& problem = ours.at(knot(to, 2), x);
    const auto fresh = path_solver()->solve(problem, start::cold);
    const auto second = path_solver();
    REQUIRE(second->adopt(first->warm_start()));
    second->carry_over(2, to.ds_m, to.steps);
    const auto taken = second->solve(problem, start::warm);
    CHECK(taken.status == converged);
    CHECK(taken.cost == test::near(fresh.cost, 1e-3));
  }
}

TEST_CASE("a plan that changes hands on the same grid is continued as well") {
  const auto first = steering(80, 1);
  const auto second = path_solver();
  REQUIRE(second->adopt(first->warm_start()));
  slalom road;
  const auto& next = road.at(1, state_at(*first, 1));
  for (auto* solver : {first.get(), second.get()})
    solver->shift(1);
  const auto kept = first->solve(next, start::warm);
  const auto taken = second->solve(next, start::warm);
  CHECK(taken.status == converged);
  CHECK(taken.cost == test::near(kept.cost, 1e-5));
  CHECK(taken.iterations <= kept.iterations + 1);
}

TEST_CASE("nobody goes on from what is no plan") {
  auto memory = steering(80, 1)->warm_start();
  const auto solver = steering(80, 1);
  const auto before = solver->offset_m()[40];
  SUBCASE("no steps") {
    memory.steps = 0;
  }
  SUBCASE("too many steps") {
    memory.steps = ocp::most_steps + 1;
  }
  SUBCASE("steps of no length") {
    memory.ds_m = 0;
  }
  SUBCASE("steps of hardly any length") {
    memory.ds_m = 1e-300;
  }
  SUBCASE("steps that are longer than streets") {
    memory.ds_m = 1e300;
  }
  SUBCASE("steps that are no number") {
    memory.ds_m = std::numeric_limits<double>::quiet_NaN();
  }
  SUBCASE("a state that is no number") {
    memory.x1[80] = std::numeric_limits<float>::quiet_NaN();
  }
  SUBCASE("a multiplier without end") {
    memory.force[2][7] = std::numeric_limits<float>::infinity();
  }
  CHECK_FALSE(solver->adopt(memory));
  CHECK(solver->offset_m()[40] == before);
  CHECK(path_solver()->warm_start().usable() == false);
}

TEST_CASE("what is known of no place is not gone on from") {
  constexpr auto nan = std::numeric_limits<double>::quiet_NaN();
  constexpr auto inf = std::numeric_limits<double>::infinity();
  CHECK(is_sound(planner_memory{}));
  for (const auto nowhere : {nan, inf, -inf}) {
    planner_memory path, speed;
    path.path_s_m = nowhere;
    speed.speed_s_m = nowhere;
    CHECK_FALSE(is_sound(path));
    CHECK_FALSE(is_sound(speed));
  }
}

TEST_CASE("carried over to nonsense, a solver starts cold") {
  slalom road;
  const auto& problem = road.at(0, {});
  const auto cold = path_solver()->solve(problem, start::cold);
  for (const auto by : {-1., std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::infinity()}) {
    const auto solver = steering(80, 1);
    solver->carry_over(by, 1, 80);
    CHECK(solver->solve(problem, start::warm).iterations == cold.iterations);
  }
  for (const auto steps : {0, -1, ocp::most_steps + 1}) {
    const auto solver = steering(80, 1);
    solver->carry_over(1, 1, steps);
    CHECK(solver->solve(problem, start::warm).iterations == cold.iterations);
  }
}
