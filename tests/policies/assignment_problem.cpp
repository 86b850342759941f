// Tests of what an assignment is worth, and of what is refused.
#include "policies/algorithms/assignment/problem.hpp"
#include "tests/support/assignments.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>
#include <string>

namespace sofof::policies::assignment {

using doctest::Approx;
using test::open_problem;

namespace {

/// Two vehicles and two providers, where the first serves the first vehicle.
problem two_by_two() {
  auto p = open_problem(2, 2);
  p.gains << 0.5, 0.6, 0.4, 0.7;
  p.present[0] = 0;
  p.switching_price = 0.05;
  p.resources.push_back({pair_table::Constant(2, 2, 0.6), {1, 1}});
  return p;
}

std::string complaint_about(const problem& p) {
  try {
    check(p);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

} // namespace

TEST_CASE("a change of provider costs the switching price twice, a start or an "
          "end once") {
  const auto p = two_by_two();
  CHECK(worth(p, 0, 0) == Approx(0.5));
  CHECK(worth(p, 0, 1) == Approx(0.6 - 0.1));
  CHECK(worth(p, 0, local) == Approx(-0.05));
  CHECK(worth(p, 1, 1) == Approx(0.7 - 0.05));
  CHECK(worth(p, 1, local) == 0);
  CHECK(value(p, {1, local}) == Approx(0.5));
}

TEST_CASE("an assignment that overfills a provider is not feasible") {
  const auto p = two_by_two();
  CHECK(feasible(p, {0, 1}));
  CHECK(feasible(p, {local, 1}));
  CHECK_FALSE(feasible(p, {1, 1}));
}

TEST_CASE("an assignment to a provider that may not serve is not feasible") {
  auto p = two_by_two();
  p.eligible(1, 1) = false;
  CHECK_FALSE(feasible(p, {0, 1}));
  CHECK(feasible(p, {0, local}));
}

TEST_CASE("a second resource limits like the first") {
  auto p = two_by_two();
  p.resources.push_back({pair_table::Constant(2, 2, 0.3), {0.2, 1}});
  CHECK_FALSE(feasible(p, {0, 1}));
  CHECK(feasible(p, {local, 1}));
}

TEST_CASE("decimals that sum up to a capacity fill it") {
  auto p = open_problem(3, 1);
  p.resources.push_back({pair_table::Constant(3, 1, 0.1), {0.3}});
  CHECK(0.1 + 0.1 + 0.1 > 0.3);
  CHECK(feasible(p, {0, 0, 0}));
}

TEST_CASE("a provider without capacity serves those who want nothing of it") {
  auto p = open_problem(2, 1);
  p.resources.push_back({pair_table::Zero(2, 1), {0}});
  p.resources.front().demand(1, 0) = 1e-6;
  CHECK(feasible(p, {0, local}));
  CHECK_FALSE(feasible(p, {local, 0}));
}

TEST_CASE("a problem that makes no sense is refused with a sentence") {
  constexpr auto nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(complaint_about(two_by_two()).empty());
  auto p = two_by_two();
  p.gains(1, 0) = nan;
  CHECK(
      complaint_about(p)
      == "assignment: the gain of vehicle 1 at provider 0 is not finite; give "
         "a number, or make the pair not eligible.");
  p.eligible(1, 0) = false;
  CHECK(complaint_about(p).empty());
  p = two_by_two();
  p.eligible.resize(2, 1);
  CHECK(complaint_about(p)
        == "assignment: eligible has 2 x 1 entries; make it vehicles x "
           "providers, 2 x 2.");
  p = two_by_two();
  p.resources.front().demand(0, 1) = -1;
  CHECK(
      complaint_about(p)
      == "assignment: the demand for resource 0 of vehicle 0 at provider 1 is "
         "-1.000000; give a finite number that is not negative.");
  p = two_by_two();
  p.resources.front().capacity = {1};
  CHECK(complaint_about(p)
        == "assignment: resource 0 has 1 capacities; give one to each of 2 "
           "providers.");
  p.resources.front().capacity = {1, nan};
  CHECK(complaint_about(p)
        == "assignment: a capacity of resource 0 is nan; give a number that is "
           "not negative.");
  p = two_by_two();
  p.present[1] = 2;
  CHECK(complaint_about(p)
        == "assignment: present names provider 2 of 2; give its index, or "
           "local.");
  p.present.pop_back();
  CHECK(complaint_about(p)
        == "assignment: present has 1 choices; give one to each of 2 "
           "vehicles.");
  p = two_by_two();
  p.switching_price = -1;
  CHECK(complaint_about(p)
        == "assignment: the switching price is -1.000000; give a finite number "
           "that is not negative.");
}

} // namespace sofof::policies::assignment
