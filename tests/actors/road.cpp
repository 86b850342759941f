// Tests of the road: it shows everybody what they perceive, and sees who
// collides.
#include "actors/road.hpp"

#include "tests/support/toy_streets.hpp"
#include "tests/support/virtual_world.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace sofof;
using namespace sofof::test;

namespace {

/// Two vehicles on one straight street.
struct road_world : virtual_world {
  const vehicle_params size;
  streets_ptr world = one_street();
  probe<recorder_actor> recorder = listen<recorder_actor>();
  probe<vehicle_actor> behind = listen<vehicle_actor>();
  probe<vehicle_actor> ahead = listen<vehicle_actor>();
  road_actor road = own(spawn_road(
      system(), world, {{1, world->routes.front()}, {2, world->routes.front()}},
      size, recorder.handle));

  static streets_ptr one_street() {
    auto world = std::make_shared<streets>();
    world->map =
        road_map{"street", {}, {toy::straight("street", {0, 0}, {500, 0})}};
    world->routes.push_back(world->map.make_route(
        "street", std::vector<std::string>{"street"}, false));
    return world;
  }

  void report(station_id who, double s_m, double speed_mps,
              const probe<vehicle_actor>& vehicle) {
    tell(road, motion_report{who, s_m, {{s_m, 0}, 0, speed_mps, 0.5, 0}},
         vehicle.handle);
  }
  std::size_t collisions() const { return recorder->count<collision_record>(); }
};

} // namespace

TEST_CASE_FIXTURE(road_world,
                  "everybody known perceives every 50 ms, nobody else") {
  report(1, 100, 5, behind);
  run_for(1s);
  const auto times = behind->times<perception>();
  REQUIRE(times.size() >= 20);
  for (std::size_t k = 1; k < times.size(); ++k)
    CHECK(times[k] - times[k - 1] == 50ms);
  CHECK(behind->all<perception>().back().at == times.back());
  CHECK(ahead->entries().empty());
}

TEST_CASE_FIXTURE(road_world, "alone on the road one perceives nobody") {
  report(1, 100, 5, behind);
  run_for(100ms);
  CHECK(!behind->all<perception>().back().lead);
}

TEST_CASE_FIXTURE(road_world, "who drives behind perceives who drives ahead, "
                              "down to the rear bumper") {
  report(1, 100, 5, behind);
  report(2, 130, 7, ahead);
  run_for(100ms);
  const auto lead = behind->all<perception>().back().lead;
  REQUIRE(lead);
  CHECK(lead->station == 2);
  CHECK(lead->speed_mps == 7);
  CHECK(lead->accel_mps2 == 0.5);
  CHECK(lead->rear_s_m == doctest::Approx(130 - size.rear_m));
  CHECK(!ahead->all<perception>().back().lead);
}

TEST_CASE_FIXTURE(road_world, "what is perceived moves with the reports") {
  report(1, 100, 5, behind);
  report(2, 130, 7, ahead);
  run_for(100ms);
  report(2, 140, 7, ahead);
  run_for(100ms);
  const auto lead = behind->all<perception>().back().lead;
  REQUIRE(lead);
  CHECK(lead->rear_s_m == doctest::Approx(140 - size.rear_m));
}

TEST_CASE_FIXTURE(road_world, "a station without a way is not on the road") {
  report(3, 100, 5, behind);
  run_for(1s);
  CHECK(behind->entries().empty());
}

TEST_CASE_FIXTURE(road_world, "near is not touching") {
  report(1, 100, 5, behind);
  report(2, 100 + size.front_m + size.rear_m + 0.01, 5, ahead);
  run_for(1s);
  CHECK(collisions() == 0);
}

TEST_CASE_FIXTURE(road_world, "a collision is recorded once per touch") {
  report(1, 100, 5, behind);
  report(2, 100 + size.front_m + size.rear_m - 0.01, 5, ahead);
  run_for(1s);
  REQUIRE(collisions() == 1);
  const auto touch = recorder->all<collision_record>().front();
  CHECK(touch.first == 1);
  CHECK(touch.second == 2);
  CHECK(touch.at == recorder->times<collision_record>().front());

  report(2, 130, 5, ahead); // they part, and touch again
  run_for(1s);
  CHECK(collisions() == 1);
  report(2, 104, 5, ahead);
  run_for(1s);
  CHECK(collisions() == 2);
}

TEST_CASE_FIXTURE(road_world, "who has left the streets is in nobody's way") {
  report(1, 100, 5, behind);
  report(2, 130, 7, ahead);
  run_for(100ms);
  REQUIRE(behind->all<perception>().back().lead);
  tell(road, station_id{2});
  tell(road, station_id{2}); // twice does no harm
  ahead->clear();
  run_for(100ms);
  CHECK(!behind->all<perception>().back().lead);
  CHECK(ahead->entries().empty());
}
