// When a vehicle's own function is done, in virtual time.
#include "actors/offloading/own_function.hpp"

#include "tests/support/echo_service.hpp"

#include <doctest/doctest.h>

#include <cstdint>

using namespace sofof;
using namespace sofof::actors;

namespace {

/// @returns what a result takes from the start of its cycle on, mean, s.
double mean_time_s(const channel::core_wait& host) {
  requester_actor_setup vehicle;
  vehicle.station = 101;
  vehicle.noise = random_stream{1, "vehicle"};
  vehicle.host = host;
  const auto service =
      offloading::in_vehicle(test::echo_service("echo"), {vehicle.station});
  const auto own = own_function(vehicle, service, [] { return time_point{}; });
  double sum_s = 0;
  constexpr std::uint64_t cycles = 20'000;
  for (std::uint64_t k = 0; k < cycles; ++k)
    sum_s += to_seconds(own.finish(time_point{}, k).done - time_point{});
  return sum_s / cycles;
}

} // namespace

TEST_CASE("a vehicle's own function waits for a core of the host") {
  using namespace std::chrono_literals;
  const auto longer_s =
      mean_time_s({.probability = 0.5, .mean = 8ms}) - mean_time_s({});
  CHECK(longer_s == doctest::Approx(0.004).epsilon(0.05));
}
