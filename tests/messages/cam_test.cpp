// The CAM: one whose octets are known, its limits, and what is refused.
#include "messages/etsi/cam.hpp"

#include "messages/etsi/explain.hpp"
#include "messages/etsi/hex.hpp"
#include "messages/etsi/message.hpp"
#include "messages/etsi/uper.hpp"
#include "tests/messages/codec_laws.hpp"

#include <doctest/doctest.h>

#include <array>

namespace sofof::messages::etsi {
namespace {

/// A car in Ulm that turns left at 30 km/h.
cam turning_car() {
  cam m;
  m.header.station = 101;
  m.body.generation = 12345;
  auto& [basic, high, low, special] = m.body.parameters;
  basic.station_type = passenger_car;
  basic.position = {484'412'345,
                    99'612'345,
                    {50, 30, 900},
                    {57'000, altitude_confidence::within_50_cm}};
  auto& motion = std::get<vehicle_high_frequency>(high.value);
  motion.heading = {900, 5};
  motion.speed = {833, 10};
  motion.drive_direction = drive_direction::forward;
  motion.length = {45, trailer_indication::none};
  motion.width = 18;
  motion.acceleration = {-5, 3};
  motion.curvature = {100, curvature_confidence::within_0_002};
  motion.curvature_mode = curvature_calculation_mode::yaw_rate_not_used;
  motion.yaw_rate = {477, yaw_rate_confidence::within_1};
  auto& past = std::get<0>(low.emplace().value);
  past.lights.set(0);
  past.path_history.push_back({{-100, -2000, 10}, 100});
  past.path_history.push_back({{200, 3000, -20}, {}});
  return m;
}

/// These octets as tshark 4.0.17 reads them: 48°26'28.444"N 9°57'40.444"E,
/// heading east, 8.33 m/s, 4.5 m by 1.8 m, -0.5 m/s², curvature 300 m left,
/// 4.77 °/s left, low beam on, and two points of path history.
constexpr auto turning_car_hex =
    "0202000000653039405a508e972e273917206403c7084ca90a00384081a08902c08a6c1c63"
    "66076cc10015ff9b7e0bd8d30018d0063c176ec620";

std::string hex_of(const cam& m) {
  std::string hex;
  append_hex(hex, encode_message(m).value.value());
  return hex;
}

} // namespace

TEST_CASE("a CAM becomes the octets that others read as we mean them") {
  CHECK(hex_of(turning_car()) == turning_car_hex);
  cam back;
  REQUIRE(decode(*octets_from_hex(turning_car_hex), back));
  CHECK(hex_of(back) == turning_car_hex);
  const auto& motion = std::get<0>(back.body.parameters.high_frequency.value);
  CHECK(motion.speed.value == 833);
  CHECK(motion.curvature.value == 100);
}

TEST_CASE("a CAM with nothing but what must be there has 41 octets") {
  CHECK(encoded_size(cam{}) == 41);
}

TEST_CASE("the ends of what a CAM can say go there and back") {
  auto m = turning_car();
  auto& position = m.body.parameters.basic.position;
  auto& motion = std::get<0>(m.body.parameters.high_frequency.value);
  for (const auto end : {-900'000'000, 900'000'000, latitude_unavailable}) {
    position.latitude = end;
    position.longitude = 2 * (end / 900'000'000) * 900'000'000;
    position.altitude.value = altitude_unavailable;
    motion.curvature.value = end < 0 ? -1023 : curvature_unavailable;
    motion.yaw_rate.value = end < 0 ? -32766 : yaw_rate_unavailable;
    cam back;
    REQUIRE(decode(encode_message(m).value.value(), back));
    const auto& same = back.body.parameters.basic.position;
    CHECK(same.latitude == position.latitude);
    CHECK(same.longitude == position.longitude);
    CHECK(hex_of(back) == hex_of(m));
  }
}

TEST_CASE("a CAM that says what cannot be said is not encoded") {
  auto m = turning_car();
  m.body.parameters.basic.position.latitude = latitude_unavailable + 1;
  std::array<std::byte, 100> room{};
  CHECK(encode(m, room) == 0);
  CHECK(explain_encoding(m)
        == "cam.camParameters.basicContainer.referencePosition.latitude = "
           "900000002 is beyond 900000001");
  m = turning_car();
  m.header.protocol_version = 1;
  CHECK(encode(m, room) == 0);
  CHECK(explain_encoding(m)
        == "this is a CAM of protocol version 1, and not a CAM of protocol "
           "version 2");
}

TEST_CASE("a CAM that ends early is refused, and told where") {
  const auto octets = *octets_from_hex(turning_car_hex);
  for (std::size_t size = 0; size < octets.size(); ++size) {
    cam m;
    CHECK(!decode(std::span{octets}.first(size), m));
    const auto why = explain_decoding<cam>(std::span{octets}.first(size));
    CHECK(why.find("more than are left") != why.npos);
  }
  CHECK(explain_decoding<cam>(std::span{octets}.first(9))
        == "cam.camParameters.basicContainer.stationType needs 8 bits, more "
           "than are left, at bit 68 of 72");
}

TEST_CASE("other messages are refused by their header") {
  auto octets = *octets_from_hex(turning_car_hex);
  octets[0] = std::byte{1};
  cam m;
  CHECK(!decode(octets, m));
  CHECK(explain_decoding<cam>(octets)
        == "this is a CAM of protocol version 1, and not a CAM of protocol "
           "version 2");
  CHECK(decode_message(octets).error
        == "a CAM of protocol version 1 is not known, only CAM of protocol "
           "version 2, CPM of protocol version 1, CPM of protocol version 2, "
           "MCM of protocol version 2");
  octets[1] = std::byte{1};
  const auto denm = decode_message(octets);
  CHECK(!denm.value);
  CHECK(denm.error.starts_with("a DENM of protocol version 1 is not known"));
  octets[1] = std::byte{99};
  CHECK(decode_message(octets).error.starts_with(
      "a message 99 of protocol version 1 is not known"));
  CHECK(decode_message({}).error
        == "the message ends before it tells what it is");
}

TEST_CASE("CAMs of any content come back, within their ranges") {
  test::check_random_messages<cam>(500);
  test::check_ranges<cam>(5);
}
TEST_CASE("CAMs that end early or are damaged do no harm") {
  test::check_truncation<cam>(20);
  test::check_damage<cam>(1000);
}
TEST_CASE("what a later version adds to the CAM is skipped") {
  test::check_additions<cam>(64);
}

} // namespace sofof::messages::etsi
