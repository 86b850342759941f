// The longest response time under which a scene is safe that was told.
#include "planners/safety/scene_response.hpp"

#include <doctest/doctest.h>

#include <limits>

using namespace sofof;
using namespace sofof::planners;

namespace {

constexpr auto most_s = 5.0;
constexpr auto forever = std::numeric_limits<double>::infinity();

/// The vehicle's rear axle is 100 m along its way.
struct told_street {
  driving_scene scene;
  scene_viewer me{100, 0, 0, 10, 0, false};
  rss_assumptions assumed;
  world::vehicle_params car;

  double front_m() const { return 100 + car.front_m; }
  safe_response look() const {
    return longest_safe_response(scene, me, assumed, car, most_s);
  }
};

} // namespace

TEST_CASE_FIXTURE(told_street, "an empty scene leaves all the time") {
  CHECK(look().longest_s == most_s);
  CHECK(look().because == "free");
}

TEST_CASE_FIXTURE(told_street, "behind a lead that is told the time is that of "
                               "the distance to it") {
  scene.lead = lead_vehicle{{}, front_m() + 20, 5, 0};
  CHECK(look().longest_s == follows_safely_s({20, 10, 5}, assumed.lon));
  CHECK(look().because == "follow");
  scene.lead->rear_s_m = front_m() + 5;
  CHECK(look().longest_s == 0);
}

TEST_CASE_FIXTURE(told_street, "a body beside the way matters if it is near "
                               "along and across") {
  scene.beside = {{front_m() + 6, front_m() + 11, 1.2, 3, -8}};
  const auto near = look();
  CHECK(near.because == "oncoming");
  CHECK(near.longest_s < 1.5);
  scene.beside[0].low_m = 4;
  scene.beside[0].high_m = 6;
  CHECK(look().longest_s > near.longest_s);
  scene.beside[0].from_m = 40;
  scene.beside[0].to_m = 45; // behind
  CHECK(look().longest_s == most_s);
}

TEST_CASE_FIXTURE(told_street, "in a bend the own body swings out towards who "
                               "is outside") {
  scene.beside = {{front_m() + 6, front_m() + 11, 2.5, 4.5, -8}};
  const auto straight_s = look().longest_s;
  me.curvature_1pm = -0.08; // to the right
  CHECK(look().longest_s < straight_s);
  me.curvature_1pm = 0.08;
  CHECK(look().longest_s == straight_s);
}

TEST_CASE_FIXTURE(told_street, "who comes first to a crossing and cannot stop "
                               "any more makes it a place to stop at") {
  const auto from_m = front_m() + 20;
  scene.crossings = {{from_m, from_m + 4, 1, 3, true, 7, 1}};
  const auto stop_s = longest_response_s(10, 20, assumed.lon);
  CHECK(look().longest_s == stop_s);
  CHECK(look().because == "crossing");
  SUBCASE("not who can stop still") {
    scene.crossings[0].brakes_mps2 = 2;
    CHECK(look().longest_s == most_s);
  }
  SUBCASE("nor who gives way") {
    scene.crossings[0].goes_first = false;
    CHECK(look().longest_s == most_s);
  }
  SUBCASE("nor who comes where priority was given") {
    me.has_priority = true;
    CHECK(look().longest_s == most_s);
  }
  SUBCASE("but who stands there, whoever has priority") {
    me.has_priority = true;
    scene.crossings[0].enter_s = 0;
    scene.crossings[0].leave_s = forever;
    CHECK(look().longest_s == stop_s);
    scene.crossings[0].goes_first = false;
    CHECK(look().longest_s == stop_s);
  }
}
