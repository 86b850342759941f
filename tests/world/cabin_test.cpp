// The cabin's heat balance and its climate control.
#include "world/vehicle/cabin.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace sofof;
using namespace sofof::world;
using doctest::Approx;

namespace {

const cabin_params cabin;

double heat_j(const cabin_state& x) {
  return cabin.air_capacity_jpk * x.air_c + cabin.mass_capacity_jpk * x.mass_c;
}

} // namespace

TEST_CASE("no heat is lost or made up") {
  for (const auto dt_s : {0.1, 1.0, 10.0})
    for (const auto power_w : {-4000.0, 0.0, 5000.0})
      for (const auto outside_c : {-20.0, 20.0, 40.0}) {
        cabin_state x{15, 30};
        for (auto i = 0; i < 20; ++i) {
          const auto next = step(x, power_w, outside_c, cabin, dt_s);
          const auto in_w =
              power_w + cabin.solar_gain_w
              + cabin.air_to_outside_wpk * (outside_c - next.air_c);
          CHECK(heat_j(next) - heat_j(x) == Approx(dt_s * in_w).epsilon(1e-6));
          x = next;
        }
      }
}

TEST_CASE("short and long steps tell the same story") {
  cabin_state fine{5, 5}, coarse{5, 5};
  for (auto i = 0; i < 6000; ++i)
    fine = step(fine, 3000, -5, cabin, 0.1);
  for (auto i = 0; i < 60; ++i)
    coarse = step(coarse, 3000, -5, cabin, 10);
  CHECK(std::abs(fine.air_c - coarse.air_c) < 0.3);
  CHECK(std::abs(fine.mass_c - coarse.mass_c) < 0.3);
}

TEST_CASE("left alone, a cabin ends as warm as the sun makes it") {
  cabin_state x{-10, 50};
  for (auto i = 0; i < 20000; ++i)
    x = step(x, 0, 10, cabin, 10);
  const auto rest_c = 10 + cabin.solar_gain_w / cabin.air_to_outside_wpk;
  CHECK(x.air_c == Approx(rest_c));
  CHECK(x.mass_c == Approx(rest_c));
}

TEST_CASE("climate control brings the air to the set point and holds it") {
  for (const auto outside_c : {-10.0, 35.0}) {
    cabin_state x{outside_c, outside_c};
    for (auto i = 0; i < 1800; ++i)
      x = step(x, climate_power_w(x, outside_c, 21, 60, cabin), outside_c,
               cabin, 1);
    CHECK(x.air_c == Approx(21).epsilon(0.02));
  }
}

TEST_CASE("climate control keeps the device's limits") {
  CHECK(climate_power_w({-20, -20}, -20, 22, 60, cabin) == cabin.max_heating_w);
  CHECK(climate_power_w({50, 50}, 40, 20, 60, cabin) == -cabin.max_cooling_w);
}

TEST_CASE("no other constant power does better over the horizon") {
  const cabin_state start{19, 15};
  const auto badness = [&](double power_w) {
    auto x = start;
    auto sum = 0.0;
    for (auto i = 0; i < 30; ++i) {
      x = step(x, power_w, 5, cabin, 10);
      sum += (x.air_c - 21) * (x.air_c - 21);
    }
    return sum;
  };
  const auto best_w = climate_power_w(start, 5, 21, 300, cabin);
  CHECK(best_w > 0);
  CHECK(best_w < cabin.max_heating_w);
  CHECK(badness(best_w) < badness(best_w + 20));
  CHECK(badness(best_w) < badness(best_w - 20));
}
