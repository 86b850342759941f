// The MCM: what each container takes, and what is refused.
#include "messages/etsi/mcm.hpp"

#include "messages/etsi/explain.hpp"
#include "messages/etsi/message.hpp"
#include "messages/etsi/uper.hpp"
#include "tests/messages/codec_laws.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <bitset>
#include <string>

namespace sofof::messages::etsi {
namespace {

/// A suggestion to follow `points` waypoints exactly.
mcm suggestion(std::size_t points) {
  mcm m;
  auto& container =
      m.body.parameters.maneuver.value.emplace<suggested_maneuver_container>();
  container.target = 101;
  auto& maneuver = container.maneuver.emplace();
  maneuver.participants.push_back(101);
  auto& all = std::get<maneuver_constraints>(maneuver.parameters.value);
  all.waypoints.resize(points);
  for (std::size_t i = 0; i < points; ++i) {
    auto& point = all.waypoints[i];
    point.waypoint = {static_cast<std::int32_t>(70 * i), -5};
    point.min_arrival_time = static_cast<std::uint16_t>(100 * i);
    point.max_arrival_time = point.min_arrival_time;
    point.min_velocity = point.max_velocity = speed_value{700};
  }
  return m;
}

mcm plan(std::size_t points) {
  mcm m;
  auto& user = std::get<road_user_container>(m.body.parameters.maneuver.value);
  auto& planned = user.planned_trajectory.emplace();
  planned.points.resize(points);
  return m;
}

/// An unsigned number in so many bits, the highest first.
std::string bits(int count, std::uint32_t number) {
  return std::bitset<32>{number}.to_string().substr(
      static_cast<std::size_t>(32 - count));
}

} // namespace

TEST_CASE("an MCM with a plan is known bit by bit") {
  auto m = plan(1);
  m.header.station = 101;
  m.body.generation = 1000;
  m.body.parameters.basic.station_type = passenger_car;
  auto& at = m.body.parameters.basic.position;
  at.latitude = 484'010'822;
  at.longitude = 99'876'076;
  at.confidence = {50, 40, 900};
  at.altitude.value = 49'500;
  at.altitude.confidence = altitude_confidence::within_1_m;
  auto& user = std::get<road_user_container>(m.body.parameters.maneuver.value);
  user.state = {road_user_type::connected_automated_vehicle, 1389, 1800, 47,
                19};
  auto& planned = *user.planned_trajectory;
  planned.start_delta_time = 20;
  planned.delta_time = 100;
  planned.points[0] = {{138, -7}, 1390, 1801};
  auto expected = bits(8, 2) + bits(8, 20) + bits(32, 101) // header
                  + bits(16, 1000)   // generationDeltaTime
                  + "0" + bits(8, 5) // basicContainer: no more of it
                  + bits(31, 484'010'822 + 900'000'000)  // latitude
                  + bits(32, 99'876'076 + 1'800'000'000) // longitude
                  + bits(12, 50) + bits(12, 40) + bits(12, 900)
                  + bits(20, 49'500 + 100'000) + bits(4, 6) // within 1 m
                  + "0"                                     // roadUserContainer
                  + "100" // of three, plannedTrajectory
                  + "0" + bits(3, 1) + bits(14, 1389) + bits(12, 1800)
                  + bits(6, 47 - 1) + bits(6, 19 - 1) // roadUserState
                  + bits(16, 20) + bits(8, 100 - 1) // startDeltaTime, deltaTime
                  + "0" + bits(7, 1 - 1)            // one point
                  + bits(18, 138 + 131'072) + bits(18, 131'072 - 7)
                  + bits(14, 1390) + bits(12, 1801);
  expected.append((8 - expected.size() % 8) % 8, '0');
  CHECK(test::to_bits(test::uper_of(m)) == expected);
}

TEST_CASE("an MCM takes the octets that its points need") {
  // 62 bits a point of a plan; 68 bits and two speeds of 14 each a suggestion.
  CHECK(encoded_size(plan(50)) == 422);
  CHECK((encoded_size(plan(51)) * 8 - encoded_size(plan(43)) * 8) == 8 * 62);
  CHECK(encoded_size(suggestion(58)) - encoded_size(suggestion(50))
        == 6 + 68 + 28);
}

TEST_CASE("a suggested maneuver arrives as it was sent") {
  const auto octets = encode_message(suggestion(50)).value.value();
  mcm back;
  REQUIRE(decode(octets, back));
  const auto& container = std::get<1>(back.body.parameters.maneuver.value);
  CHECK(container.target == 101);
  const auto& all = std::get<0>(container.maneuver->parameters.value);
  REQUIRE(all.waypoints.size() == 50);
  CHECK(all.waypoints[49].waypoint.x == 3430);
  CHECK(all.waypoints[49].max_arrival_time == 4900);
  CHECK(*all.waypoints[49].max_velocity == 700);
  CHECK(!all.waypoints[49].preceding);
  CHECK(encode_message(back).value.value() == octets);
}

TEST_CASE("there is at least one point, and at most 128") {
  CHECK(encode_message(plan(128)).value);
  CHECK(encode_message(plan(0)).error
        == "mcm.mcmParameters.maneuverContainer.roadUserContainer."
           "plannedTrajectory.trajectoryPointContainer has 0 entries, and only "
           "1 to 128 are allowed");
  CHECK(!encode_message(plan(129)).value);
}

TEST_CASE("the end of a maneuver has a reason, the unknown one being last") {
  mcm m = suggestion(1);
  auto& container = std::get<1>(m.body.parameters.maneuver.value);
  container.maneuver->parameters.value = termination_status::reason_unknown;
  const auto octets = encode_message(m).value.value();
  mcm back;
  REQUIRE(decode(octets, back));
  const auto& same = std::get<1>(back.body.parameters.maneuver.value);
  CHECK(std::get<termination_status>(same.maneuver->parameters.value)
        == termination_status::reason_unknown);
  container.maneuver->parameters.value = static_cast<termination_status>(6);
  CHECK(!encode_message(m).value);
}

TEST_CASE("MCMs of any content come back, within their ranges") {
  test::check_random_messages<mcm>(500);
  test::check_ranges<mcm>(5);
}
TEST_CASE("MCMs that end early or are damaged do no harm") {
  test::check_truncation<mcm>(20);
  test::check_damage<mcm>(1000);
}

} // namespace sofof::messages::etsi
