// The path problem, solved: what its plans promise, and what it refuses.
#include "planners/problems/path_ocp.hpp"
#include "planners/problems/sample_problems.hpp"
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
using test::not_a_number;
using test::path_solver;

namespace {

/// A drive down the slalom: at every knot the plan's next state, with noise.
template <class Visit>
void drive_slalom(slalom& road, start how, int knots, Visit visit) {
  const auto solver = path_solver();
  test::dice dice{3};
  path_state x;
  for (int k = 0; k < knots; ++k) {
    const auto& problem = road.at(k, x);
    solver->shift(k > 0 ? 1 : 0);
    const auto report = solver->solve(problem, how);
    CAPTURE(k);
    visit(*solver, problem, report);
    x = {solver->offset_m()[1] + dice.between(-0.02, 0.02),
         solver->heading_rad()[1] + dice.between(-2e-3, 2e-3),
         solver->curvature_1pm()[1] + dice.between(-3e-4, 3e-4)};
  }
}

/// Violation of all bounds when the controls are driven from the start.
double driven_violation(const path_problem& p, std::span<const double> u) {
  std::array<double, 3> x{p.start.d_m, p.start.heading_rad,
                          p.start.curvature_1pm};
  auto worst = 0.;
  for (std::size_t k = 0; k < u.size(); ++k) {
    worst = std::max(worst, std::abs(u[k]) - p.rate_max_1pm2);
    x = ocp::path_step(x, u[k], p.curvature_1pm[2 * k],
                       p.curvature_1pm[2 * k + 1], p.ds_m);
    worst = std::max(worst, std::abs(x[2]) - p.curvature_max_1pm);
    for (const auto& disc : p.discs) {
      const auto q = x[0] + disc.ahead_m * std::sin(x[1]);
      worst = std::max({worst, q - disc.hi_m[k + 1], disc.lo_m[k + 1] - q});
    }
  }
  return worst;
}

} // namespace

TEST_CASE("every plan down the slalom is feasible and optimal") {
  for (const auto how : {start::warm, start::cold}) {
    slalom road;
    auto iterations = 0;
    drive_slalom(road, how, 120,
                 [&](auto& solver, auto& problem, auto& report) {
                   REQUIRE(report.status == converged);
                   CHECK(driven_violation(problem, solver.rate_1pm2()) < 1e-4);
                   const auto left = test::kkt_of(solver, problem, report.cost);
                   CHECK(left.decrease < 2e-4);
                   CHECK(left.complementarity < 5);
                   iterations += report.iterations;
                 });
    CHECK(iterations < 120 * (how == start::warm ? 6 : 25));
  }
}

TEST_CASE("a plan is the roll-out of its controls, to the last bit") {
  slalom road;
  drive_slalom(road, start::warm, 20, [](auto& solver, auto& problem, auto&) {
    const auto& p = problem;
    std::array<double, 3> x{p.start.d_m, p.start.heading_rad,
                            p.start.curvature_1pm};
    auto far = 0.;
    for (std::size_t k = 0; k < solver.rate_1pm2().size(); ++k) {
      x = ocp::path_step(x, solver.rate_1pm2()[k], p.curvature_1pm[2 * k],
                         p.curvature_1pm[2 * k + 1], p.ds_m);
      far = std::max({far, std::abs(x[0] - solver.offset_m()[k + 1]),
                      std::abs(x[1] - solver.heading_rad()[k + 1]),
                      std::abs(x[2] - solver.curvature_1pm()[k + 1])});
    }
    CHECK(far < 1e-13); // compilers may round differently
  });
}

TEST_CASE("horizons of other lengths and steps are solved as well") {
  struct grid {
    int steps;
    double ds_m;
  };
  for (const auto& [steps, ds] :
       {grid{160, 0.5}, grid{250, 0.5}, grid{20, 1}, grid{81, 1}}) {
    CAPTURE(steps);
    slalom road{steps, ds};
    drive_slalom(road, start::warm, 30,
                 [&](auto& solver, auto& problem, auto& report) {
                   REQUIRE(report.status == converged);
                   CHECK(driven_violation(problem, solver.rate_1pm2()) < 1e-4);
                 });
  }
}

TEST_CASE("a horizon of one step is solved") {
  slalom road{1, 1};
  const auto solver = path_solver();
  CHECK(solver->solve(road.at(0, {}), start::cold).status == converged);
}

TEST_CASE("the same problem gives the same bytes") {
  const auto run = [] {
    std::vector<double> all;
    slalom road;
    drive_slalom(road, start::warm, 60, [&](auto& solver, auto&, auto& report) {
      all.insert(all.end(), solver.rate_1pm2().begin(),
                 solver.rate_1pm2().end());
      all.push_back(report.cost);
    });
    return all;
  };
  const auto first = run(), second = run();
  REQUIRE(first.size() == second.size());
  CHECK(std::memcmp(first.data(), second.data(), first.size() * sizeof(double))
        == 0);
}

TEST_CASE("a solver copied byte by byte goes on where the other was") {
  static_assert(std::is_trivially_copyable_v<path_ocp>);
  slalom road;
  const auto first = path_solver();
  CHECK(first->solve(road.at(0, {}), start::cold).status == converged);
  const auto second = path_solver();
  std::memcpy(static_cast<void*>(second.get()), first.get(), sizeof(path_ocp));
  const auto& next = road.at(1, {first->offset_m()[1], first->heading_rad()[1],
                                 first->curvature_1pm()[1]});
  for (auto* solver : {first.get(), second.get()}) {
    solver->shift(1);
    CHECK(solver->solve(next, start::warm).status == converged);
  }
  CHECK(first->rate_1pm2()[0] == second->rate_1pm2()[0]);
  CHECK(first->offset_m().back() == second->offset_m().back());
}

TEST_CASE("a cold start knows nothing of what was solved before") {
  test::dice dice{4};
  const auto used = path_solver();
  slalom sane;
  const auto fresh = path_solver();
  const auto expected = fresh->solve(sane.at(0, {.d_m = 0.1}), start::cold);
  REQUIRE(expected.status == converged);
  for (int i = 0; i < 60; ++i) {
    // Anything: any length, often hopeless, now and then overflowing.
    slalom wild{static_cast<int>(dice.between(1, ocp::most_steps)),
                dice.between(0.1, 2), dice.between(1, 8)};
    auto problem = wild.at(
        i, {dice.between(-2, 2), dice.between(-1, 1), dice.between(-0.3, 0.3)});
    const std::vector<double> sharp(problem.curvature_1pm.size(), 1e300);
    if (i % 3 == 0)
      problem.curvature_1pm = sharp, problem.start.d_m = 0;
    used->solve(problem, i % 2 == 0 ? start::warm : start::cold);
    const auto report = used->solve(sane.at(0, {.d_m = 0.1}), start::cold);
    CAPTURE(i);
    CHECK(report.status == converged);
    CHECK(report.cost == expected.cost);
    CHECK(used->rate_1pm2()[40] == fresh->rate_1pm2()[40]);
  }
}

TEST_CASE("a warm start is worth its while, and ends at the same plan") {
  slalom road;
  const auto cold = path_solver();
  auto saved = 0;
  drive_slalom(road, start::warm, 40, [&](auto&, auto& problem, auto& report) {
    const auto again = cold->solve(problem, start::cold);
    CHECK(report.cost == doctest::Approx(again.cost).epsilon(1e-3));
    saved += again.iterations - report.iterations;
  });
  CHECK(saved > 40 * 5);
}

TEST_CASE("where the car does not fit, row and knot are named at once") {
  slalom road;
  auto problem = road.at(0, {});
  std::vector<double> lo(problem.discs[1].lo_m.begin(),
                         problem.discs[1].lo_m.end());
  lo[33] = problem.discs[1].hi_m[33] + 0.1;
  auto discs = std::vector(problem.discs.begin(), problem.discs.end());
  discs[1].lo_m = lo;
  problem.discs = discs;
  const auto report = path_solver()->solve(problem, start::cold);
  CHECK(report.status == soft_infeasible);
  CHECK(report.iterations == 0);
  CHECK(report.worst.row == 1);
  CHECK(report.worst.knot == 33);
  CHECK(report.worst.amount == doctest::Approx(0.1));
}

TEST_CASE("a wall that cannot be avoided is infeasible, not a crash") {
  for (const auto how : {start::cold, start::warm}) {
    slalom road;
    const auto solver = path_solver();
    REQUIRE(solver->solve(road.at(0, {}), start::cold).status == converged);
    // At 15 m, 4 m to the side: with these bounds on the curvature no way.
    auto problem = road.at(0, {});
    auto discs = std::vector(problem.discs.begin(), problem.discs.end());
    std::vector<double> lo(81, -10), hi(81, 10);
    for (std::size_t k = 15; k < 20; ++k)
      lo[k] = 4;
    for (auto& disc : discs)
      disc.lo_m = lo, disc.hi_m = hi;
    problem.discs = discs;
    const auto report = solver->solve(problem, how);
    CHECK(report.status == soft_infeasible);
    CHECK(report.worst.scaled > 10);
    CHECK(report.worst.row >= 0);
    CHECK(report.worst.knot >= 0);
    CHECK(report.iterations <= ocp::solver_options{}.max_iterations);
    // And it is over with the wall.
    CHECK(solver->solve(road.at(0, {}), start::cold).status == converged);
  }
}

TEST_CASE("a car that cannot steer enough gets no plan, soon") {
  constexpr auto roads = 120;
  test::dice dice{7};
  auto refused = 0, early = 0;
  for (int i = 0; i < roads; ++i) {
    CAPTURE(i);
    slalom road{80, 1, dice.between(2.5, 6)};
    auto problem = road.at(i, {dice.between(-0.1, 0.1), 0, 0});
    const auto solver = path_solver();
    const auto how = i % 2 == 0 ? start::cold : start::warm;
    if (how == start::warm)
      solver->solve(problem, start::cold);
    problem.curvature_max_1pm = dice.between(0.004, 0.05);
    problem.rate_max_1pm2 = dice.between(5e-4, 0.01);
    const auto report = solver->solve(problem, how);
    if (publishable(report.status)) {
      CHECK(driven_violation(problem, solver->rate_1pm2()) <= 1.001e-3);
      continue;
    }
    CHECK(report.status == soft_infeasible);
    CHECK(report.worst.scaled > 10);
    CHECK(report.worst.knot > 0);
    ++refused;
    early += report.iterations < ocp::solver_options{}.max_iterations ? 1 : 0;
  }
  CHECK(refused > roads / 3);
  CHECK(refused < roads * 2 / 3);
  CHECK(early > refused / 2); // it is known before all steps are spent
}

TEST_CASE("a wall across the road is infeasible, and nothing overflows") {
  slalom road;
  auto problem = road.at(0, {});
  auto discs = std::vector(problem.discs.begin(), problem.discs.end());
  const std::vector<double> lo(81, 50), hi(81, 51);
  for (auto& disc : discs)
    disc.lo_m = lo, disc.hi_m = hi;
  problem.discs = discs;
  const auto report = path_solver()->solve(problem, start::cold);
  CHECK(report.status == soft_infeasible);
  CHECK(report.worst.amount > 1);
}

TEST_CASE("a corridor of no width is driven, where the car starts in it") {
  slalom road;
  auto problem = road.at(0, {});
  const std::vector<double> straight(161, 0), line(81, 0);
  problem.curvature_1pm = straight;
  auto discs = std::vector(problem.discs.begin(), problem.discs.end());
  for (auto& disc : discs)
    disc.lo_m = line, disc.hi_m = line;
  problem.discs = discs;
  const auto solver = path_solver();
  CHECK(solver->solve(problem, start::cold).status == converged);
  CHECK(std::abs(solver->offset_m().back()) < 1e-4);
}

TEST_CASE("an obstacle that pops up near the car still gives a plan") {
  slalom road;
  const auto solver = path_solver();
  REQUIRE(solver->solve(road.at(0, {}), start::cold).status == converged);
  auto problem = road.at(0, {});
  auto discs = std::vector(problem.discs.begin(), problem.discs.end());
  std::vector<double> lo(81, -2.5), hi(81, 2.5);
  for (std::size_t k = 15; k < 20; ++k)
    lo[k] = 0.5;
  for (auto& disc : discs)
    disc.lo_m = lo, disc.hi_m = hi;
  problem.discs = discs;
  CHECK(solver->solve(problem, start::warm).status == converged);
  CHECK(driven_violation(problem, solver->rate_1pm2()) < 1e-4);
}

TEST_CASE("what makes no sense is refused") {
  slalom road;
  const auto& good = road.at(0, {});
  const std::vector<double> short_line(80, 0), with_nan(161, not_a_number),
      sharp(161, 3);
  const std::vector<double> beside(81, 0.3);
  auto problem = good;
  auto discs = std::vector(good.discs.begin(), good.discs.end());
  SUBCASE("no steps") {
    problem.steps = 0;
  }
  SUBCASE("negative steps") {
    problem.steps = -3;
  }
  SUBCASE("too many steps") {
    problem.steps = ocp::most_steps + 1;
  }
  SUBCASE("s does not grow") {
    problem.ds_m = 0;
  }
  SUBCASE("s falls") {
    problem.ds_m = -1;
  }
  SUBCASE("s is no number") {
    problem.ds_m = not_a_number;
  }
  SUBCASE("start is no number") {
    problem.start.d_m = not_a_number;
  }
  SUBCASE("start turned away") {
    problem.start.heading_rad = 1.1;
  }
  SUBCASE("start beyond the centre of the bend") {
    problem.curvature_1pm = sharp;
    problem.start.d_m = 0.3;
  }
  SUBCASE("wanted beyond the centre of the bend") {
    problem.curvature_1pm = sharp;
    problem.wanted_m = beside;
  }
  SUBCASE("curvature is no number") {
    problem.curvature_1pm = with_nan;
  }
  SUBCASE("curvature too short") {
    problem.curvature_1pm = short_line;
  }
  SUBCASE("nothing wanted") {
    problem.wanted_m = {};
  }
  SUBCASE("no discs") {
    problem.discs = {};
  }
  SUBCASE("too many discs") {
    discs.resize(5, discs[0]);
    problem.discs = discs;
  }
  SUBCASE("corridor too short") {
    discs[0].lo_m = short_line;
    problem.discs = discs;
  }
  SUBCASE("corridor is no number") {
    discs[2].hi_m = std::span{with_nan}.first(81);
    problem.discs = discs;
  }
  SUBCASE("rate bounds too long") {
    problem.rate_max_at_1pm2 = with_nan;
  }
  SUBCASE("negative limit") {
    problem.curvature_max_1pm = -1;
  }
  SUBCASE("free control") {
    problem.weights.rate = 0;
  }
  const auto report = path_solver()->solve(problem, start::warm);
  CHECK(report.status == bad_input);
  CHECK(report.iterations == 0);
}

TEST_CASE("a deadline ends the iteration in time") {
  slalom road;
  for (int most = 0; most < 12; ++most) {
    const auto ask = [most](int done) { return done < most; };
    const auto report =
        path_solver()->solve(road.at(0, {}), start::cold, {}, ocp::budget{ask});
    CAPTURE(most);
    CHECK(report.iterations <= most);
    if (report.iterations < most)
      CHECK(report.status == converged);
    else
      CHECK((report.status == budget || report.status == acceptable
             || report.status == converged));
  }
  const auto never = [](int) { return false; };
  CHECK(
      path_solver()
          ->solve(road.at(0, {.d_m = 0.5}), start::cold, {}, ocp::budget{never})
          .status
      == budget);
}

TEST_CASE("noise five times as large is still planned for") {
  slalom road;
  test::dice dice{9};
  const auto solver = path_solver();
  auto good = 0;
  for (int k = 0; k < 100; ++k) {
    solver->shift(k > 0 ? 1 : 0);
    const auto status = solver
                            ->solve(road.at(k, {dice.between(-0.2, 0.2),
                                                dice.between(-0.04, 0.04),
                                                dice.between(-5e-3, 5e-3)}),
                                    start::warm)
                            .status;
    CHECK(status != numerical);
    good += publishable(status) ? 1 : 0;
  }
  CHECK(good > 60); // between obstacles such jumps may be too much
}
