// When a vehicle's own function is done, in virtual time.
#include "actors/offloading/own_function.hpp"

#include "actors/offloading/measured_times.hpp"
#include "tests/support/echo_service.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>

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

/// Its cycles took 2 ms and 4 ms in turn.
struct measured_function final : offloading::service_function, measured_times {
  offloading::service_output
  run(time_point, const messages::service_input& input) override {
    return input.what;
  }
  std::optional<duration> measured(std::uint64_t cycle) const override {
    return std::chrono::milliseconds{cycle % 2 == 0 ? 2 : 4};
  }
};

struct measured_in_vehicle final : offloading::vehicle_service {
  std::shared_ptr<offloading::service_function> make_function() const override {
    return std::make_shared<measured_function>();
  }
};

} // namespace

TEST_CASE("cycles take what was measured, on a slow computer longer") {
  using namespace std::chrono_literals;
  requester_actor_setup vehicle;
  vehicle.station = 101;
  auto service =
      offloading::in_vehicle(test::echo_service("echo"), {vehicle.station});
  service.own = std::make_shared<measured_in_vehicle>();
  const auto time_of = [&](std::uint64_t cycle) {
    const auto own =
        own_function(vehicle, service, [] { return time_point{}; });
    return own.finish(time_point{1s}, cycle).done - time_point{1s};
  };
  CHECK(time_of(0) == 2ms);
  CHECK(time_of(3) == 4ms);
  vehicle.computer.clock_ghz = 1.5;
  CHECK(time_of(3) == 8ms);
}

TEST_CASE("a vehicle's own function waits for a core of the host") {
  using namespace std::chrono_literals;
  const auto longer_s =
      mean_time_s({.probability = 0.5, .mean = 8ms}) - mean_time_s({});
  CHECK(longer_s == doctest::Approx(0.004).epsilon(0.05));
}
