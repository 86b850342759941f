// What planners keep of a plan, while others use the solver.
#include "planners/problems/sample_problems.hpp"
#include "tests/planners/solvers.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

using namespace sofof;
using namespace sofof::planners;
using ocp::start;
using test::path_solver;
using test::speed_solver;

namespace {

bool are_same(std::span<const double> a, std::span<const double> b) {
  return std::ranges::equal(a, b); // to the last bit
}

/// Not finite where no plan was found.
bool are_same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool are_same(const path_ocp& a, const path_ocp& b) {
  return are_same(a.offset_m(), b.offset_m())
         && are_same(a.heading_rad(), b.heading_rad())
         && are_same(a.curvature_1pm(), b.curvature_1pm())
         && are_same(a.rate_1pm2(), b.rate_1pm2());
}

bool are_same(const velocity_ocp& a, const velocity_ocp& b) {
  return are_same(a.t_s(), b.t_s()) && are_same(a.w_m2ps2(), b.w_m2ps2())
         && are_same(a.accel_mps2(), b.accel_mps2())
         && are_same(a.u_1ps2(), b.u_1ps2());
}

/// Now and then there is no time for a single step.
ocp::budget in_time(int knot) {
  static constexpr auto no = [](int) { return false; };
  return knot % 7 == 3 ? ocp::budget{no} : ocp::budget{};
}

path_state second_knot(const path_ocp& x) {
  return {x.offset_m()[1], x.heading_rad()[1], x.curvature_1pm()[1]};
}

} // namespace

TEST_CASE("cars whose paths are solved in turn by one solver drive as if each "
          "had its own") {
  constexpr auto cars = 3;
  const auto shared = path_solver();
  std::array<ocp::kept_plan, cars> kept;
  std::array<std::unique_ptr<path_ocp>, cars> own{path_solver(), path_solver(),
                                                  path_solver()};
  for (auto knot = 0; knot < 60; ++knot)
    for (std::size_t car = 0; car < cars; ++car) {
      const auto width_m =
          5.0 + static_cast<double>(car); // and horizons differ
      slalom road{60 + 20 * static_cast<int>(car), 1, width_m};
      const auto how = knot == 0 ? start::cold : start::warm;
      const auto from = knot == 0 ? path_state{} : second_knot(*own[car]);
      const auto& next = road.at(knot, from);
      own[car]->shift(1);
      const auto alone = own[car]->solve(next, how, {}, in_time(knot));
      shared->resume(kept[car]);
      shared->shift(1);
      const auto together = shared->solve(next, how, {}, in_time(knot));
      shared->keep(kept[car]);
      CAPTURE(knot);
      CHECK(alone.status == together.status);
      CHECK(alone.iterations == together.iterations);
      CHECK(are_same(alone.cost, together.cost));
      CHECK(are_same(*own[car], *shared));
    }
}

TEST_CASE("cars whose speeds are solved in turn by one solver drive as if each "
          "had its own, whatever happens on the road") {
  using event = practice_road::event;
  constexpr std::array events{event::free_flow, event::slow_leader,
                              event::stop_line, event::crossing};
  const auto shared = speed_solver();
  std::array<ocp::kept_plan, events.size()> kept;
  std::array<std::unique_ptr<velocity_ocp>, events.size()> own{
      speed_solver(), speed_solver(), speed_solver(), speed_solver()};
  std::array<double, events.size()> now_s{};
  for (auto knot = 0; knot < 120; ++knot)
    for (std::size_t car = 0; car < events.size(); ++car) {
      practice_road road{events[car], 160, 0.5};
      auto& mine = *own[car];
      const auto first = knot == 0;
      if (!first)
        now_s[car] += mine.t_s()[1];
      const auto& next = road.at(
          knot, now_s[car],
          first ? velocity_state{0, 60, 0}
                : velocity_state{0, mine.w_m2ps2()[1], mine.accel_mps2()[1]});
      const auto how = first ? start::cold : start::warm;
      mine.shift(1);
      const auto alone = mine.solve(next, how, {}, in_time(knot));
      shared->resume(kept[car]);
      shared->shift(1);
      const auto together = shared->solve(next, how, {}, in_time(knot));
      shared->keep(kept[car]);
      CAPTURE(knot);
      CAPTURE(car);
      CHECK(alone.status == together.status);
      CHECK(are_same(alone.cost, together.cost));
      CHECK(are_same(mine, *shared));
    }
}

TEST_CASE("of a plan on board little is kept: a few kilobytes") {
  const auto solver = path_solver();
  slalom road;
  REQUIRE(ocp::publishable(solver->solve(road.at(0, {}), start::cold).status));
  ocp::kept_plan kept;
  solver->keep(kept);
  CHECK(kept.knots.size() == 4 * 81);
  CHECK(kept.multipliers.size() < 81);
  CHECK(std::ranges::all_of(kept.multipliers,
                            [](const auto& x) { return x.y != 0; }));
}

TEST_CASE("of what was not solved nothing is kept, and one goes on cold") {
  const auto solver = path_solver();
  ocp::kept_plan kept;
  kept.steps = 80;
  solver->keep(kept);
  CHECK(kept.is_empty());
  slalom road;
  const auto& problem = road.at(0, {});
  const auto cold = path_solver()->solve(problem, start::cold);
  REQUIRE(ocp::publishable(solver->solve(problem, start::cold).status));
  solver->resume(kept);
  const auto warm = solver->solve(problem, start::warm);
  CHECK(warm.cost == cold.cost);
  CHECK(warm.iterations == cold.iterations);
}
