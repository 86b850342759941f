// A provider that rides with a vehicle.
#include "tests/actors/driving_world.hpp"
#include "tests/actors/provider_world.hpp"

#include <cmath>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::test;

namespace sofof::test::riding {

constexpr station_id leader = 901;

/// Its area is a square of 200 m, and its reach 90 m.
struct riding_world : provider_world {
  riding_world() {
    auto made = setup();
    made.reach_m = 90;
    provider = own(actors::spawn_service_provider(system(), std::move(made)));
    ride({500, 0}, 0);
  }

  void ride(point to, double speed_mps, double heading_rad = 0) {
    tell(provider,
         ego_state{cam{leader, now(), to, heading_rad, speed_mps, 0}, 0});
  }

  /// Both drive east for some time, the station `ahead_m` before the leader.
  void drive_along(duration d, double ahead_m, double speed_mps = 10) {
    for (auto left = d; left >= 100ms; left -= 100ms) {
      run_for(100ms);
      x_m += 0.1 * speed_mps;
      ride({x_m, 0}, speed_mps);
      hear(point{x_m + ahead_m, 0});
    }
  }
  double x_m = 500;
};

/// A vehicle with a provider on board, which is also the one near by.
struct leading_world : driving_world {
  probe<roadside_provider_actor> rider = listen<roadside_provider_actor>();
  std::shared_ptr<channel::vehicle_place> place =
      std::make_shared<channel::vehicle_place>();
  std::vector<std::size_t> reached; // of its antennas
  messages::vehicle_actor first = spawn_leader();

  messages::vehicle_actor spawn_leader() {
    actors::vehicle_setup setup;
    setup.car = {station,
                 way,
                 100,
                 10,
                 {},
                 200ms,
                 alone_limit,
                 100ms,
                 std::make_shared<const planners::route_profile>(
                     way, planners::comfort_limits{})};
    setup.plans = actors::make_plan_client();
    setup.v2x = v2x_options{};
    setup.where = in_ulm();
    setup.place = place;
    setup.rider = rider.handle;
    setup.antennas = std::make_shared<const std::vector<actors::antenna>>(
        std::vector<actors::antenna>{
            {{100, 0}, 500, station_id{station}, place}, {{100, 0}, 500}});
    setup.connect = [this](std::size_t antenna) {
      reached.push_back(antenna);
      return antenna == 0 ? near.handle : distant.handle;
    };
    setup.road = road.handle;
    setup.recorder = recorder.handle;
    setup.spawn_requester = [this](const messages::vehicle_actor&) {
      return requester.handle;
    };
    return own(actors::spawn_vehicle(system(), std::move(setup)));
  }
};

} // namespace sofof::test::riding

using namespace sofof::test::riding;

TEST_CASE_FIXTURE(riding_world,
                  "the offers of a provider that rides tell where "
                  "it is, how it moves and how far it reaches") {
  ride({500, 20}, 10, std::acos(0));
  hear({510, 20});
  REQUIRE(offers().size() == 1);
  const auto offer = offers().front();
  CHECK(offer.position == point{500, 20});
  REQUIRE(offer.moves);
  CHECK(offer.moves->velocity_mps.x_m == doctest::Approx(0));
  CHECK(offer.moves->velocity_mps.y_m == doctest::Approx(10));
  CHECK(offer.moves->reach_m == 90);
}

TEST_CASE_FIXTURE(provider_world, "a provider that stands says nothing of its "
                                  "motion") {
  hear(inside);
  CHECK_FALSE(offers().front().moves);
}

TEST_CASE_FIXTURE(riding_world,
                  "who drives along stays in the area, however far "
                  "it goes") {
  place = {520, 0};
  hear(place);
  start({one, two});
  drive_along(60s, 20); // 600 m
  CHECK(episodes().empty());
}

TEST_CASE_FIXTURE(riding_world, "who stays behind loses its services with the "
                                "first CAM from outside") {
  place = {500, 0};
  hear(place);
  start({one, two});
  drive_along(5s, 0);
  CHECK(episodes().empty());
  ride({x_m + 300, 0}, 10);
  hear({x_m, 0});
  REQUIRE(episodes().size() == 2);
  CHECK(episodes().front().reason == end_reason::left_area);
}

TEST_CASE_FIXTURE(riding_world,
                  "a CAM counts by where the area was when it was "
                  "made") {
  place = {405, 0};
  hear(place);
  start({one});
  run_for(1s);
  ride({506, 0}, 10); // the rim is at 406 m now, and was at 405 m 100 ms ago
  hear(cam{station, now() - 100ms, {405.5, 0}, 0, 10, 0}, requester);
  CHECK(episodes().empty());
  hear(cam{station, now(), {405.5, 0}, 0, 10, 0}, requester);
  CHECK(episodes().size() == 1);
}

TEST_CASE_FIXTURE(riding_world,
                  "a provider that rides tells where it is once a "
                  "second, though all its services run") {
  place = {500, 0};
  hear(place);
  start({one, two});
  drive_along(10s, 0);
  const auto all = offers();
  CHECK(all.size() >= 10);
  CHECK(all.back().services.empty());
  CHECK(all.back().position.x_m > 580);
}

TEST_CASE_FIXTURE(riding_world, "no vehicle serves itself") {
  hear(point{500, 0}, requester, leader);
  CHECK(offers().empty());
  auto request = make_request({one});
  request.station = leader;
  ask(request);
  REQUIRE(verdicts().size() == 1);
  CHECK_FALSE(verdicts().front().accepted);
}

TEST_CASE_FIXTURE(leading_world,
                  "a provider on board is told ten times a second where its "
                  "vehicle is, and what that sees and says") {
  tell(first, world::perception{now(), {}, {{{150, 1}, 0, 3, 0, 4.5, 1.8}}});
  run_for(2s);
  const auto motion = rider->all<ego_state>();
  CHECK(motion.size() == 20);
  CHECK(motion.back().own.station == station);
  REQUIRE(rider->count<roadside_detections>() == 1);
  CHECK(rider->all<roadside_detections>().front().objects.size() == 1);
  CHECK(rider->count<its_pdu>() == distant->count<its_pdu>());
  CHECK(rider->count<its_pdu>() > 0);
}

TEST_CASE_FIXTURE(leading_world, "a vehicle does not reach its own provider by "
                                 "radio") {
  run_for(2s);
  CHECK(reached == std::vector<std::size_t>{1});
  for (const auto& to : rider->seconds<requester_actor>())
    CHECK_FALSE(to);
}

TEST_CASE("an antenna that rides hears who is near its vehicle, once that is "
          "anywhere, and not that vehicle") {
  const auto place = std::make_shared<channel::vehicle_place>();
  const actors::antenna on_board{{0, 0}, 100, station_id{101}, place};
  CHECK_FALSE(on_board.hears(102, {0, 0}));
  place->tell({1000, 0});
  CHECK_FALSE(on_board.hears(102, {0, 0}));
  CHECK(on_board.hears(102, {900, 0}));
  CHECK_FALSE(on_board.hears(102, {899, 0}));
  CHECK_FALSE(on_board.hears(101, {1000, 0}));
}
