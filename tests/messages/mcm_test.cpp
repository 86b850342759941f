// The MCM: what each container takes, and what is refused.
#include "messages/etsi/mcm.hpp"

#include "messages/etsi/explain.hpp"
#include "messages/etsi/message.hpp"
#include "messages/etsi/uper.hpp"
#include "tests/messages/codec_laws.hpp"

#include <doctest/doctest.h>

#include <algorithm>

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

} // namespace

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
