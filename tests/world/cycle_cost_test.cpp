// What a cycle costs a vehicle.
#include "world/vehicle/cycle_cost.hpp"

#include "tests/support/option_list.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::world;

TEST_CASE("planning on board takes 10 ms and 27 mJ a cycle") {
  const auto cost = on_board_cost({}, {});
  CHECK(cost.time_s == doctest::Approx(0.010));
  CHECK(cost.energy_j == doctest::Approx(0.027));
}

TEST_CASE("half the clock takes twice the time and a quarter of the energy") {
  const auto usual = on_board_cost({}, {});
  const auto slow = on_board_cost({.clock_ghz = 1.5}, {});
  CHECK(slow.time_s == doctest::Approx(2 * usual.time_s));
  CHECK(slow.energy_j == doctest::Approx(usual.energy_j / 4));
}

TEST_CASE("offloaded, a cycle costs what sending its input does") {
  const auto cost = offloaded_cost({}, {});
  CHECK(cost.energy_j == doctest::Approx(0.2 * 160e3 / 20e6));
  CHECK(cost.time_s == doctest::Approx(160e3 / 20e6 + 3e7 / 12e9));
  const auto small = offloaded_cost({}, {.input_kbit = 0, .overhead_j = 0.5});
  CHECK(small.energy_j == doctest::Approx(0.5));
  CHECK(small.time_s == doctest::Approx(0.0025));
}

TEST_CASE("a slow radio can eat up what offloading saves") {
  const computer_options far{.uplink_mbps = 1};
  CHECK(offloaded_cost(far, {}).energy_j > on_board_cost(far, {}).energy_j);
}

TEST_CASE("computer and cycle list their options once, within their ranges") {
  test::option_list options;
  computer_options{}.visit_options(options);
  cycle_options{}.visit_options(options);
  CHECK(options.refused.empty());
  CHECK(options.names.size() == 11);
}
