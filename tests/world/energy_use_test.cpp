// What both ends take, and from which power on offloading pays.
#include "world/vehicle/energy_use.hpp"

#include <doctest/doctest.h>

using namespace sofof::world;
using doctest::Approx;

namespace {

constexpr vehicle_power ten_watts{10, 0.25, 2e-6, 1e-6};
constexpr server_power small_server{3, 1};

} // namespace

TEST_CASE("each part is a time or a number by its power, and parts add up") {
  const energy_use use{.computing_s = 2,
                       .resting_s = 4,
                       .octets_up = 1e6,
                       .octets_down = 3e6,
                       .framework_j = 0.5,
                       .served_s = 5};
  const auto parts = energy_of(use, ten_watts, small_server);
  CHECK(parts.computing_j == Approx(20));
  CHECK(parts.resting_j == Approx(10));
  CHECK(parts.framework_j == 0.5);
  CHECK(parts.sending_j == Approx(2));
  CHECK(parts.receiving_j == Approx(3));
  CHECK(parts.server_busy_j == Approx(15));
  CHECK(parts.server_idle_j == Approx(5));
  CHECK(parts.vehicle_j() == Approx(30.5));
  CHECK(parts.j() == Approx(30.5 + 5 + 20));
}

TEST_CASE("at the power of break-even both ways take the same") {
  energy_use use{.computing_s = 1, .resting_s = 4, .octets_up = 2e6};
  use.served_s = 3;
  const auto home_s = 5.;
  const auto w =
      break_even_w(home_s, use, energy_of(use, ten_watts, small_server), 0.25);
  REQUIRE(w);
  auto even = ten_watts;
  even.computing_w = *w;
  CHECK(energy_of(use, even, small_server).j()
        == Approx(energy_of({.computing_s = home_s}, even, {}).j()));
}

TEST_CASE("what does not relieve the vehicle's computer pays at no power") {
  const energy_use use{.computing_s = 4, .resting_s = 4};
  const auto spent = energy_of(use, ten_watts, {});
  CHECK_FALSE(break_even_w(5, use, spent, 0.25).has_value());
  CHECK(break_even_w(5.1, use, spent, 0.25).has_value());
}

TEST_CASE("a computer takes kappa f cubed, or what the user says") {
  CHECK(power_of({}).computing_w == Approx(2.7));
  CHECK(power_of({.computing_w = 40}).computing_w == 40);
  cycle_options cycle;
  cycle.run_time_mean = std::chrono::milliseconds{10};
  CHECK(on_board_cost({}, cycle).energy_j
        == Approx(0.01 * power_of({}).computing_w));
  CHECK(on_board_cost({.computing_w = 40}, cycle).energy_j == Approx(0.4));
}

TEST_CASE("an octet takes what the radio takes in its time") {
  const computer_options radio{
      .transmit_power_w = 1, .uplink_mbps = 8, .receiving_share = 0.5};
  CHECK(power_of(radio).sending_j == Approx(1e-6));
  CHECK(power_of(radio).receiving_j == Approx(0.5e-6));
}
