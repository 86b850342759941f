// A solve takes nothing from the heap.
#include "planners/practice.hpp"
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
