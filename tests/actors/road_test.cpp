// Tests of the road: it shows everybody what they perceive, and sees who
// collides.
#include "actors/simulation/road.hpp"

#include "tests/support/toy_streets.hpp"
#include "tests/support/virtual_world.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;
using namespace sofof::world;

namespace {

/// Two vehicles on one straight street.
struct road_world : virtual_world {
  const vehicle_params size;
  streets_ptr world = one_street();
  probe<recorder_actor> recorder = listen<recorder_actor>();
  probe<vehicle_actor> behind = listen<vehicle_actor>();
  probe<vehicle_actor> ahead = listen<vehicle_actor>();
  probe<roadside_provider_actor> provider = listen<roadside_provider_actor>();
  road_actor road = own(spawn_road(system(), setup()));

  road_setup setup() const {
    road_setup s;
    s.world = world;
    s.ways = {{1, world->routes.front()}, {2, world->routes.front()}};
    s.car = size;
    s.noise = random_stream{1, "sensors"};
    s.recorder = recorder.handle;
    return s;
  }

  /// A sensor without errors.
  static sensor exact_sensor(point at) {
    sensor s;
    s.can.position_noise_m = s.can.speed_noise_mps = s.can.heading_noise_rad =
        0;
    s.at = at;
    return s;
  }

  /// A street from west to east, with a house beside it.
  static streets_ptr one_street() {
    auto world = std::make_shared<streets>();
    world->map = road_map{"street",
                          {},
                          {toy::straight("street", {0, 0}, {500, 0})},
                          {{{{200, 5}, {220, 5}, {220, 25}, {200, 25}}}}};
    world->routes.push_back(world->map.make_route(
        "street", std::vector<std::string>{"street"}, false));
    return world;
  }

  void report(station_id who, double s_m, double speed_mps,
              const probe<vehicle_actor>& vehicle) {
    tell(road, motion_report{who, s_m, {{s_m, 0}, 0, speed_mps, 0.5, 0}},
         vehicle.handle);
  }
  static perception last(const probe<vehicle_actor>& who) {
    return who->all<perception>().back();
  }
  /// Of a body whose rear axle is there.
  point middle(double s_m) const {
    return {s_m + (size.front_m - size.rear_m) / 2, 0};
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
  CHECK(last(behind).at == times.back());
  CHECK(ahead->entries().empty());
}

TEST_CASE_FIXTURE(road_world, "alone on the road one perceives nobody") {
  report(1, 100, 5, behind);
  run_for(100ms);
  CHECK(last(behind).objects.empty());
}

TEST_CASE_FIXTURE(road_world, "what is perceived moves with the reports") {
  report(1, 100, 5, behind);
  report(2, 130, 7, ahead);
  run_for(100ms);
  report(2, 140, 7, ahead);
  run_for(100ms);
  REQUIRE(last(behind).objects.size() == 1);
  CHECK(distance_m(last(behind).objects[0].centre, middle(140)) < 0.5);
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

TEST_CASE_FIXTURE(road_world, "who comes near too fast is noted once") {
  const auto touch_m = size.front_m + size.rear_m;
  report(1, 100, 15, behind);
  report(2, 100 + touch_m + 16, 5, ahead); // 1.6 s
  run_for(1s);
  CHECK(recorder->count<event_record>() == 0);
  report(2, 100 + touch_m + 14, 5, ahead);
  run_for(1s);
  const auto events = recorder->all<event_record>();
  REQUIRE(events.size() == 1);
  CHECK(events[0].what == event_type::near_miss);
  CHECK(events[0].station == 1);
  CHECK(events[0].detail == "with 2 ttc_s=1.400 limit_s=1.500");
  CHECK(collisions() == 0);
}

TEST_CASE_FIXTURE(road_world, "who has left the streets is in nobody's way") {
  report(1, 100, 5, behind);
  report(2, 130, 7, ahead);
  run_for(100ms);
  REQUIRE(last(behind).objects.size() == 1);
  tell(road, station_id::rep{2});
  tell(road, station_id::rep{2}); // twice does no harm
  ahead->clear();
  run_for(100ms);
  CHECK(last(behind).objects.empty());
  CHECK(ahead->entries().empty());
}

TEST_CASE_FIXTURE(road_world, "who wants to appear on an empty street is let "
                              "in, and perceives") {
  tell(road, begin_atom_v, motion_report{1, 100, {{100, 0}, 0, 0, 0, 0}},
       behind.handle);
  run_for(50ms);
  CHECK(behind->count<begin_atom>() == 1);
  CHECK(behind->count<perception>() > 0);
  run_for(1s);
  CHECK(behind->count<begin_atom>() == 1);
}

TEST_CASE_FIXTURE(road_world,
                  "who wants to appear waits until nobody is near") {
  report(2, 110, 0, ahead);
  run_for(100ms);
  tell(road, begin_atom_v, motion_report{1, 100, {{100, 0}, 0, 0, 0, 0}},
       behind.handle);
  run_for(10s);
  CHECK(behind->entries().empty());
  report(2, 300, 0, ahead);
  run_for(100ms);
  CHECK(behind->count<begin_atom>() == 1);
  CHECK(last(ahead).objects.empty()); // too far to be seen
}

TEST_CASE_FIXTURE(road_world, "of two who want one place the lower station "
                              "appears") {
  run_for(10ms); // between two looks
  for (const auto who : {2, 1})
    tell(road, begin_atom_v,
         motion_report{
             static_cast<station_id>(who), 100, {{100, 0}, 0, 0, 0, 0}},
         (who == 1 ? behind : ahead).handle);
  run_for(10s);
  CHECK(behind->count<begin_atom>() == 1);
  CHECK(ahead->entries().empty());
  CHECK(collisions() == 0);
}

TEST_CASE_FIXTURE(road_world, "everybody sees the others from the middle of "
                              "the own body, not quite where they are") {
  report(1, 100, 5, behind);
  report(2, 130, 7, ahead);
  run_for(100ms);
  const auto view = last(behind);
  REQUIRE(view.objects.size() == 1); // not oneself
  const auto& seen = view.objects.front();
  CHECK(distance_m(seen.centre, middle(130)) < 0.5);
  CHECK(distance_m(seen.centre, middle(130)) > 0);
  CHECK(std::abs(seen.speed_mps - 7) < 0.5);
  CHECK(seen.length_m == size.front_m + size.rear_m);
  CHECK(seen.width_m == size.width_m);

  const auto back = last(ahead);
  REQUIRE(back.objects.size() == 1);
  CHECK(std::abs(back.objects.front().speed_mps - 5) < 0.5);
}

TEST_CASE_FIXTURE(road_world, "a vehicle's sensor reaches a hundred metres") {
  report(1, 100, 5, behind);
  report(2, 199.9, 7, ahead);
  run_for(100ms);
  CHECK(last(behind).objects.size() == 1);
  report(2, 200.1, 7, ahead);
  run_for(100ms);
  CHECK(last(behind).objects.empty());
}

TEST_CASE_FIXTURE(road_world, "two look at the same and err each for itself, "
                              "anew every time") {
  auto s = setup();
  s.obstacles = {{{115, 5}, 0, 4.5, 1.8}};
  road = own(spawn_road(system(), s));
  report(1, 100, 5, behind);
  report(2, 130, 7, ahead);
  run_for(200ms);
  const auto obstacle = [](const probe<vehicle_actor>& who, std::size_t k) {
    const auto views = who->all<perception>();
    for (const auto& o : views.at(k).objects)
      if (o.length_m == 4.5)
        return o.centre;
    return point{};
  };
  CHECK(distance_m(obstacle(behind, 1), {115, 5}) < 0.5);
  CHECK(distance_m(obstacle(ahead, 1), {115, 5}) < 0.5);
  CHECK_FALSE(obstacle(behind, 1) == obstacle(ahead, 1));
  CHECK_FALSE(obstacle(behind, 1) == obstacle(behind, 2));
}

TEST_CASE_FIXTURE(road_world, "an obstacle is seen and hides who is behind "
                              "it") {
  auto s = setup();
  s.obstacles = {{{120, 0}, 0, 4.5, 2.5}};
  road = own(spawn_road(system(), s));
  report(1, 100, 5, behind);
  report(2, 140, 7, ahead);
  run_for(100ms);
  const auto view = last(behind);
  REQUIRE(view.objects.size() == 1);
  CHECK(view.objects.front().length_m == 4.5);
  CHECK(view.objects.front().width_m == 2.5);
}

TEST_CASE_FIXTURE(road_world, "to touch an obstacle is a collision, once") {
  auto s = setup();
  s.obstacles = {{{300, 0}, 0, 4, 2}, {{200, 0}, 0, 4, 2}, {{199, 0}, 0, 4, 2}};
  road = own(spawn_road(system(), s));
  report(1, 196.9 - size.front_m, 5, behind);
  run_for(1s);
  CHECK(collisions() == 0); // obstacles may touch each other
  report(1, 197.1 - size.front_m, 5, behind);
  run_for(1s);
  REQUIRE(collisions() == 1);
  const auto touch = recorder->all<collision_record>().front();
  CHECK(touch.first == 1);
  CHECK(touch.second == obstacle_id(2));
}

TEST_CASE_FIXTURE(road_world, "a provider is told what each of its sensors "
                              "sees, every 50 ms") {
  auto s = setup();
  s.beside = {{provider.handle, exact_sensor({150, 0})},
              {provider.handle, exact_sensor({210, 30})}};
  road = own(spawn_road(system(), s));
  run_for(100ms);
  for (const auto& view : provider->all<roadside_detections>())
    CHECK(view.objects.empty());
  report(1, 206, 5, behind); // behind the house, seen from the second one
  provider->clear();
  run_for(1s);
  const auto views = provider->all<roadside_detections>();
  REQUIRE(views.size() == 40);
  const auto times = provider->times<roadside_detections>();
  for (std::size_t k = 0; k < views.size(); k += 2) {
    CHECK(views[k].at == times[k]);
    CHECK(times[k + 1] == times[k]);
    REQUIRE(views[k].objects.size() == 1);
    CHECK(views[k].objects.front().speed_mps == 5);
    CHECK(views[k + 1].objects.empty());
  }
  CHECK(times[2] - times[0] == 50ms);
}
