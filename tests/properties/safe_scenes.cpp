// Vehicles that offload only while the scene is safe under the response time
// that this may lead to; tests/acceptance/chain/rule drives 10 000 such scenes.
#include "tests/support/safe_scenes.hpp"

#include <doctest/doctest.h>

using namespace sofof::test;

namespace {

scene_findings driven(const scene_policy& how, std::uint64_t scenes) {
  scene_findings sum;
  for (std::uint64_t seed = 1; seed <= scenes; ++seed) {
    const auto x = drive_scene(seed, how);
    if (sum.first.empty())
      sum.first = x.first;
    sum.add(x);
  }
  return sum;
}

} // namespace

TEST_CASE("in scenes that start safe nobody is hit, no service leaves when the "
          "distance would be less than RSS's, and when it becomes less the "
          "car brakes in time, or is safe again at home") {
  const auto found = driven({}, 20);
  CAPTURE(found.first);
  CHECK(found.scenes > 15);
  CHECK(found.collisions == 0);
  CHECK(found.entered == 0);
  CHECK(found.late == 0);
  CHECK(found.home_late == 0);
  CHECK(found.changes > 20);
  CHECK(found.remote_s > found.driven_s / 4);
}

TEST_CASE(
    "who finds the scene unsafe while a provider starts does not wait for "
    "it") {
  for (const std::uint64_t seed : {3867, 5328}) {
    CAPTURE(seed);
    CHECK(drive_scene(seed, {}).entered == 0);
  }
}

TEST_CASE("so it is for a chain, of which a provider takes what the scene "
          "leaves time for") {
  const auto found = driven({.is_chain = true}, 8);
  CAPTURE(found.first);
  CHECK(found.collisions == 0);
  CHECK(found.entered == 0);
  CHECK(found.late == 0);
  CHECK(found.home_late == 0);
  CHECK(found.changes > 8);
}

TEST_CASE("without the governor, on a slow channel with wide limits, services "
          "leave in scenes that are not safe under the time of that") {
  CHECK(driven({.lodm = "location", .is_slow = true}, 8).entered > 0);
}
