// A warm start that moves by any distance, and changes grids.
#include "planners/problems/sample_problems.hpp"
#include "tests/planners/solvers.hpp"
#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <memory>
#include <vector>

using namespace sofof;
using namespace sofof::planners;
using enum ocp::solve_status;
using ocp::start;
using event = practice_road::event;
using test::path_solver;
using test::speed_solver;

namespace {

/// A velocity solver that has a plan for the practice road.
std::unique_ptr<velocity_ocp> driving_solver(event what, int steps,
                                             double ds_m) {
  auto solver = speed_solver();
  practice_road road{what, steps, ds_m};
  REQUIRE(solver->solve(road.at(0, 0, {0, 60, 0}), start::cold).status
          == converged);
  return solver;
}

/// A path solver that has a plan for the slalom.
std::unique_ptr<path_ocp> steering_solver(int steps, double ds_m) {
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
  const auto solver = driving_solver(event::slow_leader, 160, 0.5);
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
  const auto solver = driving_solver(event::free_flow, 160, 0.5);
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
  const auto solver = steering_solver(80, 1);
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
  const auto solver = driving_solver(event::stop_line, 250, 0.5);
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
  const auto solver = steering_solver(80, 0.5);
  const auto warm = solver->solve(coarse.at(0, {}), start::warm);
  const auto cold = path_solver()->solve(coarse.at(0, {}), start::cold);
  CHECK(warm.iterations == cold.iterations);
  CHECK(warm.cost == cold.cost);
}

TEST_CASE("carried over to nonsense, a solver starts cold") {
  slalom road;
  const auto& problem = road.at(0, {});
  const auto cold = path_solver()->solve(problem, start::cold);
  for (const auto by : {-1., std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::infinity()}) {
    const auto solver = steering_solver(80, 1);
    solver->carry_over(by, 1, 80);
    CHECK(solver->solve(problem, start::warm).iterations == cold.iterations);
  }
  for (const auto steps : {0, -1, ocp::most_steps + 1}) {
    const auto solver = steering_solver(80, 1);
    solver->carry_over(1, 1, steps);
    CHECK(solver->solve(problem, start::warm).iterations == cold.iterations);
  }
}
