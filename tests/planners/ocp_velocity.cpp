// The velocity problem, solved: what its plans promise, and what it refuses.
#include "planners/problems/sample_problems.hpp"
#include "planners/problems/velocity_ocp.hpp"
#include "tests/planners/solvers.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/kkt.hpp"
#include "tests/support/not_a_number.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <type_traits>
#include <vector>

using namespace sofof;
using namespace sofof::planners;
using enum ocp::solve_status;
using ocp::start;
using event = practice_road::event;
using test::not_a_number;
using test::speed_solver;

namespace {

constexpr auto tolerance = 5e-4;
constexpr auto events = {event::free_flow, event::slow_leader, event::stop_line,
                         event::crossing};

/// A drive, planned anew every metre from the plan's state there, with noise.
template <class Visit>
void drive_practice(practice_road& road, start how, int knots, Visit visit) {
  constexpr auto stride = 2;
  const auto solver = speed_solver();
  test::dice dice{5};
  velocity_state x{.t_s = 0, .w_m2ps2 = 60, .accel_mps2 = 0};
  auto now_s = 0.;
  for (int k = 0; k < knots; k += stride) {
    const auto& problem = road.at(k, now_s, x);
    solver->shift(k > 0 ? stride : 0);
    const auto report = solver->solve(problem, how);
    CAPTURE(k);
    visit(*solver, problem, report);
    now_s += solver->t_s()[stride];
    const auto w = solver->w_m2ps2()[stride];
    x = {0, std::max(0., w * (1 + dice.between(-0.01, 0.01))),
         solver->accel_mps2()[stride] + dice.between(-0.01, 0.01)};
  }
}

/// Violation of all bounds when the controls are driven from the start.
double driven_violation(const velocity_problem& p, std::span<const double> u) {
  std::array<double, 3> x{p.start.t_s, p.start.w_m2ps2, p.start.accel_mps2};
  const auto& l = p.limits;
  auto worst = 0.;
  for (std::size_t k = 0; k < u.size(); ++k) {
    const auto v = ocp::speed_of(x[1]);
    worst = std::max(worst, std::abs(u[k] * v) - l.jerk_max_mps3);
    x = ocp::velocity_step(x, u[k], p.ds_m);
    const auto [t, w, a] = x;
    worst = std::max({worst, -w, w - p.w_max_m2ps2[k + 1], l.accel_min_mps2 - a,
                      a - l.accel_max_mps2, p.earliest_s[k + 1] - t,
                      t - p.latest_s[k + 1]});
    const auto knot = static_cast<int>(k) + 1;
    if (knot >= l.total_from)
      worst = std::max(worst, std::hypot(a, 2 * w * p.curvature_1pm[k + 1])
                                  - l.total_max_mps2);
    if (p.stop_knot && knot >= *p.stop_knot)
      worst = std::max({worst, std::abs(a), w});
  }
  return worst;
}

} // namespace

TEST_CASE("every plan on the practice roads is feasible and optimal") {
  for (const auto how : {start::warm, start::cold})
    for (const auto what : events) {
      CAPTURE(static_cast<int>(what));
      practice_road road{what};
      auto iterations = 0, solves = 0;
      drive_practice(
          road, how, 130, [&](auto& solver, auto& problem, auto& report) {
            REQUIRE(report.status == converged);
            CHECK(driven_violation(problem, solver.u_1ps2())
                  < 1.01 * tolerance);
            const auto left = test::kkt_of(solver, problem, report.cost);
            CHECK(left.decrease < 2e-4);
            CHECK(left.complementarity < 5);
            iterations += report.iterations;
            ++solves;
          });
      CHECK(iterations < solves * (how == start::warm ? 20 : 80));
    }
}

TEST_CASE("behind a leader the car keeps its time gap") {
  practice_road road{event::slow_leader};
  drive_practice(
      road, start::warm, 100, [](auto& solver, auto& problem, auto&) {
        for (std::size_t k = 1; k < solver.t_s().size(); ++k)
          CHECK(solver.t_s()[k] >= problem.earliest_s[k] - tolerance);
      });
}

TEST_CASE("a car stops at its line, and rests") {
  practice_road road{event::stop_line};
  drive_practice(
      road, start::warm, 130, [](auto& solver, auto& problem, auto&) {
        REQUIRE(problem.stop_knot.has_value());
        const auto stop = static_cast<std::size_t>(*problem.stop_knot);
        for (auto k = stop; k < solver.w_m2ps2().size(); ++k) {
          CHECK(solver.w_m2ps2()[k] < tolerance);
          CHECK(std::abs(solver.accel_mps2()[k]) < tolerance);
        }
        CHECK(std::isfinite(solver.t_s().back()));
      });
}

TEST_CASE("a car starts from rest") {
  practice_road road{event::free_flow};
  const auto solver = speed_solver();
  const auto& problem = road.at(0, 0, {});
  CHECK(solver->solve(problem, start::cold).status == converged);
  CHECK(solver->w_m2ps2().back() > 20);
  CHECK(driven_violation(problem, solver->u_1ps2()) < 1.01 * tolerance);
}

TEST_CASE("a speed plan is the roll-out of its controls") {
  practice_road road{event::slow_leader};
  drive_practice(road, start::warm, 20, [](auto& solver, auto& problem, auto&) {
    const auto& from = problem.start;
    std::array<double, 3> x{from.t_s, from.w_m2ps2, from.accel_mps2};
    auto far = 0.;
    for (std::size_t k = 0; k < solver.u_1ps2().size(); ++k) {
      x = ocp::velocity_step(x, solver.u_1ps2()[k], problem.ds_m);
      far = std::max({far, std::abs(x[0] - solver.t_s()[k + 1]),
                      std::abs(x[1] - solver.w_m2ps2()[k + 1]),
                      std::abs(x[2] - solver.accel_mps2()[k + 1])});
    }
    CHECK(far < 1e-10); // compilers may round differently
  });
}

TEST_CASE("horizons of other lengths are solved as well") {
  for (const auto steps : {80, 161, 250}) {
    CAPTURE(steps);
    practice_road road{event::slow_leader, steps};
    drive_practice(
        road, start::warm, 30, [&](auto& solver, auto& problem, auto& report) {
          REQUIRE(report.status == converged);
          CHECK(driven_violation(problem, solver.u_1ps2()) < 1.01 * tolerance);
        });
  }
}

TEST_CASE("a speed horizon of one step is solved") {
  practice_road road{event::free_flow, 1};
  CHECK(speed_solver()->solve(road.at(0, 0, {0, 60, 0}), start::cold).status
        == converged);
}

TEST_CASE("the same speed problem gives the same bytes") {
  static_assert(std::is_trivially_copyable_v<velocity_ocp>);
  const auto run = [] {
    std::vector<double> all;
    practice_road road{event::crossing};
    drive_practice(
        road, start::warm, 60, [&](auto& solver, auto&, auto& report) {
          all.insert(all.end(), solver.u_1ps2().begin(), solver.u_1ps2().end());
          all.push_back(report.cost);
        });
    return all;
  };
  const auto first = run(), second = run();
  REQUIRE(first.size() == second.size());
  CHECK(std::memcmp(first.data(), second.data(), first.size() * sizeof(double))
        == 0);
}

TEST_CASE("a cold start knows nothing of the speeds before") {
  test::dice dice{6};
  const auto used = speed_solver(), fresh = speed_solver();
  practice_road sane{event::slow_leader};
  const velocity_state x{0, 60, 0};
  const auto expected = fresh->solve(sane.at(0, 0, x), start::cold);
  REQUIRE(expected.status == converged);
  for (int i = 0; i < 60; ++i) {
    practice_road wild{static_cast<event>(i % 4),
                       static_cast<int>(dice.between(1, ocp::most_steps)),
                       dice.between(0.1, 2)};
    auto problem = wild.at(i, dice.between(0, 20),
                           {0, dice.between(0, 150), dice.between(-3, 3)});
    if (i % 7 == 0)
      problem.weights.accel = 1e300;
    used->solve(problem, i % 2 == 0 ? start::warm : start::cold);
    const auto report = used->solve(sane.at(0, 0, x), start::cold);
    CAPTURE(i);
    CHECK(report.status == converged);
    CHECK(report.cost == expected.cost);
    CHECK(used->u_1ps2()[80] == fresh->u_1ps2()[80]);
  }
}

TEST_CASE("what no braking and no acceleration can do is found at once") {
  practice_road road{event::free_flow};
  auto problem = road.at(0, 0, {0, 60, 0});
  const std::vector<double> free_lo(problem.earliest_s.begin(),
                                    problem.earliest_s.end());
  const std::vector<double> free_hi(problem.latest_s.begin(),
                                    problem.latest_s.end());
  auto lo = free_lo, hi = free_hi;
  auto row = velocity_ocp::time_row, knot = 0;
  SUBCASE("too late to brake for the line") {
    problem.stop_knot = 20;
    row = velocity_ocp::speed_row;
    knot = 20;
  }
  SUBCASE("too early for the slowest car") {
    lo[30] = 40, knot = 30;
  }
  SUBCASE("too late for the fastest car") {
    hi[60] = 1, knot = 60;
  }
  SUBCASE("from gate to gate faster than the limit") {
    lo[60] = 5, hi[120] = 6, knot = 120;
  }
  SUBCASE("a gate that closes before it opens") {
    lo[50] = 5, hi[50] = 4, knot = 50;
  }
  problem.earliest_s = lo;
  problem.latest_s = hi;
  const auto report = speed_solver()->solve(problem, start::cold);
  CHECK(report.status == soft_infeasible);
  CHECK(report.iterations == 0);
  CHECK(report.worst.row == row);
  CHECK(report.worst.knot == knot);
}

TEST_CASE("a plan before survives a problem that has none") {
  practice_road road{event::free_flow};
  const auto solver = speed_solver();
  const auto& good = road.at(0, 0, {0, 60, 0});
  REQUIRE(solver->solve(good, start::cold).status == converged);
  const auto speed = solver->w_m2ps2()[50];
  auto bad = good;
  bad.stop_knot = 10;
  CHECK(solver->solve(bad, start::warm).status == soft_infeasible);
  CHECK(solver->w_m2ps2()[50] == speed);
  bad.ds_m = not_a_number;
  CHECK(solver->solve(bad, start::warm).status == bad_input);
  CHECK(solver->w_m2ps2()[50] == speed);
}

TEST_CASE("when the world changes, the last plan does not mislead") {
  practice_road free{event::free_flow}, blocked{event::slow_leader};
  const velocity_state x{0, 60, 0};
  const auto solver = speed_solver();
  REQUIRE(solver->solve(free.at(0, 0, x), start::cold).status == converged);
  const auto report = solver->solve(blocked.at(0, 0, x), start::warm);
  CHECK(report.status == converged);
  const auto fresh = speed_solver()->solve(blocked.at(0, 0, x), start::cold);
  CHECK(report.cost == doctest::Approx(fresh.cost).epsilon(1e-3));
}

TEST_CASE("speed problems that make no sense are refused") {
  practice_road road{event::free_flow};
  const auto good = road.at(0, 0, {0, 60, 0});
  const std::vector<double> with_nan(161, not_a_number), zeros(161, 0);
  const std::vector<double> short_line(160, 1);
  auto problem = good;
  SUBCASE("no steps") {
    problem.steps = 0;
  }
  SUBCASE("too many steps") {
    problem.steps = ocp::most_steps + 1;
  }
  SUBCASE("s does not grow") {
    problem.ds_m = 0;
  }
  SUBCASE("driving backwards") {
    problem.start.w_m2ps2 = -1;
  }
  SUBCASE("start is no number") {
    problem.start.accel_mps2 = not_a_number;
  }
  SUBCASE("limit is no number") {
    problem.limits.accel_max_mps2 = not_a_number;
  }
  SUBCASE("cannot brake") {
    problem.limits.accel_min_mps2 = 1;
  }
  SUBCASE("no jerk allowed") {
    problem.limits.jerk_max_mps3 = 0;
  }
  SUBCASE("speed limit too short") {
    problem.w_max_m2ps2 = short_line;
  }
  SUBCASE("speed limit is no number") {
    problem.w_max_m2ps2 = with_nan;
  }
  SUBCASE("standstill wanted") {
    problem.wanted_m2ps2 = zeros;
  }
  SUBCASE("time is no number") {
    problem.latest_s = with_nan;
  }
  SUBCASE("times missing") {
    problem.earliest_s = {};
  }
  SUBCASE("curvature is no number") {
    problem.curvature_1pm = with_nan;
  }
  SUBCASE("stop where the car is") {
    problem.stop_knot = 0;
  }
  SUBCASE("free control") {
    problem.weights.jerk = 0;
  }
  const auto report = speed_solver()->solve(problem, start::warm);
  CHECK(report.status == bad_input);
  CHECK(report.iterations == 0);
}

TEST_CASE("a deadline ends the search for a speed in time") {
  practice_road road{event::crossing};
  for (const auto most : {0, 1, 5, 20}) {
    const auto ask = [most](int done) { return done < most; };
    const auto report = speed_solver()->solve(
        road.at(0, 0, {0, 60, 0}), start::cold, {}, ocp::budget{ask});
    CHECK(report.iterations == most);
    CHECK((report.status == budget || report.status == acceptable));
  }
}
