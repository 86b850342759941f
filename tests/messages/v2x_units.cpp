// Tests of ETSI's units: rounding, ends, and what is not available.
#include "messages/etsi/units.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace sofof::messages::etsi {
namespace {

constexpr auto no_number = std::numeric_limits<double>::quiet_NaN();
constexpr auto infinity = std::numeric_limits<double>::infinity();

constexpr quantity all[]{speed_mps,
                         accel_mps2,
                         curvature_1pm,
                         yaw_rate_radps,
                         velocity_mps,
                         vehicle_length_m,
                         vehicle_width_m,
                         road_user_size_m,
                         altitude_m,
                         cpm_tr_distance_m,
                         cpm_ts_distance_m,
                         cpm_tr_size_m,
                         cpm_ts_size_m,
                         mcm_distance_m,
                         speed_confidence_mps,
                         accel_confidence_mps2,
                         heading_confidence_rad,
                         semi_axis_m,
                         distance_confidence_m,
                         size_confidence_m};

} // namespace

TEST_CASE("whatever fits comes back to half a unit") {
  for (const auto& q : all) {
    for (auto wire = q.low; wire <= q.high; ++wire)
      REQUIRE(q.to_wire(*q.to_si(wire)) == wire);
    const auto si = (q.low + 0.3 * (q.high - q.low)) * q.step;
    CHECK(std::abs(*q.to_si(q.to_wire(si)) - si) <= 0.5001 * q.step);
  }
}

TEST_CASE("what is no number is unavailable, and nothing else is") {
  for (const auto& q : all) {
    CHECK(q.to_wire(no_number) == q.unavailable);
    CHECK(q.to_wire_at_least(no_number) == q.unavailable);
    CHECK(q.to_wire(std::optional<double>{}) == q.unavailable);
    CHECK(q.to_wire(infinity) == q.above);
    CHECK(q.to_wire(-infinity) == q.below);
    CHECK(!q.to_si(q.low - 1));
    CHECK(!q.to_si(q.high + 1));
    CHECK(!q.to_si(std::numeric_limits<int>::min()));
  }
}

TEST_CASE("the numbers are those of the standard") {
  CHECK(speed_mps.to_wire(8.333) == 833);
  CHECK(speed_mps.to_wire(500.0) == 16382);
  CHECK(speed_mps.unavailable == 16383);
  CHECK(accel_mps2.to_wire(-0.26) == -3);
  CHECK(accel_mps2.to_wire(-99.0) == -160);
  CHECK(accel_mps2.to_wire(no_number) == 161);
  CHECK(curvature_1pm.to_wire(-0.01234) == -123);
  CHECK(curvature_1pm.to_wire(1.0) == 1022);
  CHECK(yaw_rate_radps.to_wire(std::numbers::pi / 2) == 9000);
  CHECK(vehicle_length_m.to_wire(5.10) == 51);
  CHECK(vehicle_length_m.to_wire(110.0) == 1022);
  CHECK(vehicle_width_m.to_wire(1.89) == 19);
  CHECK(vehicle_width_m.to_wire(7.0) == 61);
  CHECK(mcm_distance_m.to_wire(-12.345) == -1234);
}

TEST_CASE("a confidence never promises too much") {
  CHECK(speed_confidence_mps.to_wire_at_least(0.05) == 5);
  CHECK(speed_confidence_mps.to_wire_at_least(0.0501) == 6);
  CHECK(speed_confidence_mps.to_wire_at_least(0.0) == 1);
  CHECK(speed_confidence_mps.to_wire_at_least(1.26) == 126);
  CHECK(heading_confidence_rad.to_wire_at_least(0.0875) == 51);
  CHECK(semi_axis_m.to_wire_at_least(41.0) == 4094);
  CHECK(curvature_confidence_1pm.to_wire(0.0) == 0);
  CHECK(curvature_confidence_1pm.to_wire(1e-4) == 1);
  CHECK(curvature_confidence_1pm.to_wire(1.1e-4) == 2);
  CHECK(curvature_confidence_1pm.to_wire(1.0) == 6);
  CHECK(curvature_confidence_1pm.to_wire(no_number) == 7);
  CHECK(*curvature_confidence_1pm.to_si(2) == 5e-4);
  CHECK(!curvature_confidence_1pm.to_si(6));
  CHECK(yaw_rate_confidence_radps.unavailable() == 8);
  CHECK(altitude_confidence_m.unavailable() == 15);
}

TEST_CASE("angles go round in a circle") {
  CHECK(angle_to_wire(0) == 0);
  CHECK(angle_to_wire(-0.1 * degree_rad) == 3599);
  CHECK(angle_to_wire(359.96 * degree_rad) == 0);
  CHECK(angle_to_wire(725 * degree_rad) == 50);
  CHECK(angle_to_wire(no_number) == unavailable_angle);
  CHECK(angle_to_wire(infinity) == unavailable_angle);
  CHECK(!angle_to_rad(3601));
  CHECK(!angle_to_rad(-1));
  for (int wire = 0; wire < 3600; ++wire)
    REQUIRE(angle_to_wire(*angle_to_rad(wire)) == wire);
}

} // namespace sofof::messages::etsi
