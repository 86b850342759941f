// What a split would take, before it is chosen.
#include "policies/api/split_energy.hpp"

#include <doctest/doctest.h>

#include <array>

using namespace sofof;
using namespace sofof::policies;
using doctest::Approx;

namespace {

constexpr world::vehicle_power vehicle{10, 0.25, 2e-6, 1e-6};
constexpr std::array servers{world::server_power{3, 1},
                             world::server_power{6, 2}};

/// Ten results a second here and there; 0.1 of a core each way.
constexpr service_rates rates{.period_s = 0.1,
                              .run_time_s = 0.01,
                              .results_per_s = 10,
                              .served_s = 0.01,
                              .inputs_per_s = 10,
                              .input_octets = 1000,
                              .input_octets_beside = 100,
                              .result_octets = 500,
                              .framework_j = 0.001};
constexpr std::array chain{rates, rates};

world::energy_parts of(std::array<service_place, 2> places) {
  return predicted_power(chain, places, vehicle, servers);
}

} // namespace

TEST_CASE("at home a chain takes what its computing takes") {
  const auto home = of({});
  CHECK(home.computing_j == Approx(2));
  CHECK(home.j() == Approx(2));
}

TEST_CASE("what follows at the same provider sends less up") {
  const auto beside = of({0, 0}), apart = of({0, 1});
  CHECK(beside.sending_j == Approx(2e-6 * 10 * 1100));
  CHECK(apart.sending_j == Approx(2e-6 * 10 * 2000));
  CHECK(beside.receiving_j == Approx(1e-6 * 10 * 1000));
  CHECK(beside.receiving_j == Approx(apart.receiving_j));
}

TEST_CASE("a worker is paid for by whose it is, and a function that rests by "
          "the share that it takes") {
  const auto split = of({std::nullopt, 1});
  CHECK(split.computing_j == Approx(1));
  CHECK(split.resting_j == Approx(0.25));
  CHECK(split.server_busy_j == Approx(0.6));
  CHECK(split.server_idle_j == Approx(0.2));
  CHECK(split.framework_j == Approx(0.01));
  CHECK(of({0, std::nullopt}).server_busy_j == Approx(0.3));
}
