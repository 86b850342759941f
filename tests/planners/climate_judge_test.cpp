// Tests of the judge of heating and cooling.
#include "planners/judges/climate_judge.hpp"

#include <doctest/doctest.h>

#include <limits>

using namespace sofof;
using namespace sofof::planners;
using namespace sofof::world;

namespace {

const cabin_params cabin;
const judged_climate cold{{5, 5}, 5, 21, 60};

} // namespace

TEST_CASE("the power that the vehicle would choose itself is used") {
  for (const auto air_c : {-10.0, 5.0, 20.0, 21.0, 35.0}) {
    const judged_climate x{{air_c, air_c}, air_c, 21, 60};
    const auto own_w = climate_power_w(x.cabin, x.outside_c, x.set_point_c,
                                       x.horizon_s, cabin);
    CHECK(!judge_climate(own_w, x, cabin));
  }
}

TEST_CASE("the power for a cabin of a second ago is used") {
  cabin_state air{-10, -10};
  double power_w = 0;
  for (int second = 0; second < 600; ++second) {
    const judged_climate now{air, -10, 21, 60};
    CHECK(!judge_climate(second == 0 ? cabin.max_heating_w : power_w, now,
                         cabin));
    power_w = climate_power_w(air, -10, 21, 60, cabin);
    air = step(air, power_w, -10, cabin, 1);
  }
}

TEST_CASE("cooling a cold cabin is refused, and heating it is not") {
  const auto refused = judge_climate(-4000, cold, cabin);
  REQUIRE(refused);
  CHECK(refused->check == "comfort");
  CHECK(!judge_climate(cabin.max_heating_w, cold, cabin));
}

TEST_CASE("what no cabin can do is refused") {
  for (const auto power_w :
       {6000.0, -5000.0, 1e300, std::numeric_limits<double>::infinity(),
        std::numeric_limits<double>::quiet_NaN()}) {
    const auto refused = judge_climate(power_w, cold, cabin);
    REQUIRE(refused);
    CHECK(refused->check == "range");
  }
}
