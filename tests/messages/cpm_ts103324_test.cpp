// The CPM of TS 103 324, against an independent codec, by hand and at random.
#include "messages/etsi/cpm_ts103324.hpp"

#include "tests/messages/codec_laws.hpp"

namespace sofof::messages::etsi::ts103324 {
namespace {

cpm smallest() {
  cpm message;
  message.header.station = 42;
  message.body.management.reference_time = 700'000'000'123;
  message.body.containers.resize(1);
  auto& sender = message.body.containers[0]
                     .value.emplace<etsi::ts103324::originating_vehicle>();
  sender.orientation = {900, 10};
  return message;
}

TEST_CASE("what an independent codec made of CPMs of TS 103 324 comes back") {
  test::check_vectors<cpm>("cpm_ts103324.hex");
}

TEST_CASE("the smallest CPM of TS 103 324 is known bit by bit") {
  CHECK(test::to_hex(test::uper_of(smallest()))
        == "020e0000002a028bed0161ef5a4e900eb49d200fffffff08eddd0f800303"
           "8412");
}

TEST_CASE("a CPM of TS 103 324 with a car is known bit by bit") {
  auto message = smallest();
  message.body.containers.resize(2);
  auto& seen = message.body.containers[1]
                   .value.emplace<etsi::ts103324::perceived_object_container>();
  seen.number_of_objects = 1;
  seen.objects.resize(1);
  auto& car = seen.objects[0];
  car.id = 7;
  car.measured_at = -50;
  car.position.x = {1234, 5};
  car.position.y = {-100, 6};
  auto& velocity =
      car.velocity.emplace().value.emplace<etsi::cartesian_velocity>();
  velocity.x = {250, 30};
  velocity.y = {0, 127};
  car.angles.emplace().z = {900, 10};
  car.x_dimension = {45, 3};
  auto& classes = car.classification.emplace();
  classes.resize(1);
  classes[0].what.value.emplace<0>(etsi::passenger_car);
  classes[0].confidence = 90;
  CHECK(test::to_hex(test::uper_of(message))
        == "020e0000002a028bed0161ef5a4e900eb49d200fffffff08eddd0f900303"
           "841241c00805a110003be7204d20047fe7001681f275ffffe0e104960805"
           "b200");
}

TEST_CASE("CPMs of TS 103 324 of any content come back") {
  test::check_random_messages<cpm>(500);
}
TEST_CASE("no number of a CPM of TS 103 324 may be beyond its range") {
  test::check_ranges<cpm>(3);
}
TEST_CASE("a CPM of TS 103 324 that ends early is refused") {
  test::check_truncation<cpm>(20);
}
TEST_CASE("a damaged CPM of TS 103 324 does no harm") {
  test::check_damage<cpm>(1000);
}
TEST_CASE("what is added to the CPM of TS 103 324 later is skipped") {
  test::check_additions<cpm>(48);
}

TEST_CASE("a container of a CPM that nobody here knows is kept as it is") {
  auto message = smallest();
  auto& container = message.body.containers[0];
  container.unknown_id = 16;
  container.value.emplace<etsi::opaque>().octets = test::from_hex("c0ffee");
  cpm decoded;
  REQUIRE(etsi::decode(test::uper_of(message), decoded));
  const auto& kept = decoded.body.containers[0];
  CHECK(kept.id() == 16);
  CHECK(std::get<etsi::opaque>(kept.value).octets == test::from_hex("c0ffee"));
}

} // namespace
} // namespace sofof::messages::etsi::ts103324
