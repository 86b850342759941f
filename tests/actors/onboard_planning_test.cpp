// Planning in the vehicle, when another source has driven meanwhile.
#include "tests/actors/planning_world.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;
using namespace sofof::world;

namespace {

/// A vehicle that stood at 20 m by its own plans until a provider took over,
/// and that its plans have set in motion.
struct moved_by_another : planning {
  moved_by_another() : planning{false} {
    stood = ask(at("3-4-5", 20, 0));
    *now += 100ms;
    ask(at("3-4-5", 20, 0));
    for (auto k = 1; k <= 5; ++k) {
      *now += 100ms;
      moving = at("3-4-5", 20 + 0.01 * k * k, 0.1 * k);
      function->observe(*now, {running, *now, payload::of(moving), {}});
    }
  }

  std::shared_ptr<const trajectory> stood;
  plan_request moving;
};

} // namespace

TEST_CASE_FIXTURE(moved_by_another,
                  "a vehicle that does not go on from a refused plan goes on "
                  "from how it moves, and not from an old plan of its own") {
  const auto plan = ask(moving);
  REQUIRE(plan);
  CHECK(plan->points.front().speed_mps == doctest::Approx(0.5));
  CHECK(plan->points.front().s_m == doctest::Approx(20.25));
}

TEST_CASE_FIXTURE(moved_by_another,
                  "a vehicle goes on from the plan in use, if it is told") {
  auto in_use = *stood;
  in_use.start = *now;
  for (auto& p : in_use.points) {
    p.s_m = 20.3;
    p.speed_mps = 0.6;
  }
  const auto plan = ask(moving, payload::of(in_use));
  REQUIRE(plan);
  CHECK(plan->points.front().speed_mps == doctest::Approx(0.6));
}
