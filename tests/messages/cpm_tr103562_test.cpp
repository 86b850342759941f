// The CPM of TR 103 562, against an independent codec, by hand and at random.
#include "messages/etsi/cpm_tr103562.hpp"

#include "tests/messages/codec_laws.hpp"

namespace sofof::messages::etsi::tr103562 {
namespace {

cpm smallest() {
  cpm message;
  message.header.station = 42;
  message.body.generation = 1000;
  message.body.parameters.management.station_type = etsi::passenger_car;
  return message;
}

TEST_CASE("what an independent codec made of CPMs of TR 103 562 comes back") {
  test::check_vectors<cpm>("cpm_tr103562.hex");
}

TEST_CASE("the smallest CPM of TR 103 562 is known bit by bit") {
  CHECK(test::to_hex(test::uper_of(smallest()))
        == "010e0000002a03e8000bad2748075a4e9007ffffff8476ee87c000");
}

TEST_CASE("a CPM of TR 103 562 with a car is known bit by bit") {
  auto message = smallest();
  auto& parameters = message.body.parameters;
  parameters.number_of_objects = 1;
  auto& car = parameters.objects.emplace();
  car.resize(1);
  car[0].id = 7;
  car[0].time_of_measurement = 100;
  car[0].x_distance = {1234, 5};
  car[0].y_distance = {-100, 6};
  car[0].x_speed = {250, 30};
  car[0].y_speed = {0, 127};
  car[0].yaw = {900, 10};
  car[0].planar_dimension_1 = {45, 10};
  auto& classes = car[0].classification.emplace();
  classes.resize(1);
  classes[0].confidence = 90;
  std::get<0>(classes[0].what.value).type.value = 3;
  CHECK(test::to_hex(test::uper_of(message))
        == "010e0000002a03e8100bad2748075a4e9007ffffff8476ee87c0001840ec"
           "8082dc82a063c0d03e4ebffffc708242d142d1018080");
}

TEST_CASE("CPMs of TR 103 562 of any content come back") {
  test::check_random_messages<cpm>(500);
}
TEST_CASE("no number of a CPM of TR 103 562 may be beyond its range") {
  test::check_ranges<cpm>(3);
}
TEST_CASE("a CPM of TR 103 562 that ends early is refused") {
  test::check_truncation<cpm>(20);
}
TEST_CASE("a damaged CPM of TR 103 562 does no harm") {
  test::check_damage<cpm>(1000);
}
TEST_CASE("what is added to the CPM of TR 103 562 later is skipped") {
  test::check_additions<cpm>(64);
}

TEST_CASE("a CPM of TR 103 562 names no points on the globe") {
  // The six relative kinds of points are the first of eight.
  etsi::tr103562::offset_point point;
  for (const auto* bits : {"0110", "0111"})
    CHECK_FALSE(
        etsi::decode(test::from_bits(bits + std::string(64, '0')), point));
}

} // namespace
} // namespace sofof::messages::etsi::tr103562
