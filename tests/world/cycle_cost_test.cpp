// What a cycle costs a vehicle.
#include "world/vehicle/cycle_cost.hpp"

#include "tests/support/option_list.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace sofof;
using namespace sofof::world;

namespace {

using namespace std::chrono_literals;

/// 10 ms at 3 GHz, from 20 000 octets.
cycle_options usual_cycle() {
  cycle_options cycle;
  cycle.run_time_mean = 10ms;
  cycle.input_octets = 20'000;
  return cycle;
}

} // namespace

TEST_CASE("a cycle of 10 ms takes 27 mJ on board") {
  const auto cost = on_board_cost({}, usual_cycle());
  CHECK(cost.time_s == doctest::Approx(0.010));
  CHECK(cost.energy_j == doctest::Approx(0.027));
}

TEST_CASE("half the clock takes twice the time and a quarter of the energy") {
  const auto usual = on_board_cost({}, usual_cycle());
  const auto slow = on_board_cost({.clock_ghz = 1.5}, usual_cycle());
  CHECK(slow.time_s == doctest::Approx(2 * usual.time_s));
  CHECK(slow.energy_j == doctest::Approx(usual.energy_j / 4));
}

TEST_CASE("an input of 160 kbit takes 8 ms and 1.6 mJ to send") {
  const auto cost = sending_cost({}, usual_cycle());
  CHECK(cost.time_s == doctest::Approx(160e3 / 20e6));
  CHECK(cost.energy_j == doctest::Approx(0.2 * 160e3 / 20e6));
}

TEST_CASE("a slow radio can eat up what offloading saves") {
  const computer_options far{.uplink_mbps = 1};
  CHECK(sending_cost(far, usual_cycle()).energy_j
        > on_board_cost(far, usual_cycle()).energy_j);
}

TEST_CASE("no drawn run time is longer than the longest") {
  cycle_options cycle{.run_time_mean = 5ms,
                      .run_time_sd = 1ms,
                      .run_time_max = 45ms,
                      .demand = {}};
  CHECK(longest_run_time(cycle) == 13'600us);
  cycle.run_time_max = 10ms;
  CHECK(longest_run_time(cycle) == 10ms);
  const auto rarest = 0.5 * 0x1p-52; // the least uniform draw there is
  CHECK(std::sqrt(-2 * std::log(rarest)) < 8.6);
}

TEST_CASE("computer and cycle list their options once, within their ranges") {
  test::option_list options;
  computer_options{}.visit_options(options);
  cycle_options{}.visit_options(options);
  CHECK(options.refused.empty());
  CHECK(options.names.size() == 11);
}
