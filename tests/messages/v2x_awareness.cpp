// What a CAM says of a vehicle, and what is understood of it.
#include "messages/etsi/units.hpp"
#include "messages/v2x/cam_content.hpp"
#include "tests/messages/v2x_sender.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/near.hpp"
#include "tests/support/on_air.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::test;
using namespace sofof::world;
using namespace std::chrono_literals;

namespace {

/// Over the air: as bytes.
etsi::cam sent(const etsi::cam& message) {
  etsi::cam got;
  REQUIRE(etsi::decode(encoded(message).view(), got));
  return got;
}

etsi::vehicle_high_frequency& motion_of(etsi::cam& message) {
  return std::get<etsi::vehicle_high_frequency>(
      message.body.parameters.high_frequency.value);
}

std::optional<cam> understood(const etsi::cam& message,
                              time_point now = start) {
  return read_cam(sent(message), car, *in_ulm(), now);
}

cam any_motion(dice& d) {
  return {static_cast<station_id>(d.between(1, 1e9)),
          start + std::chrono::milliseconds{std::lround(d.between(0, 1e7))},
          {d.between(-3000, 3000), d.between(-3000, 3000)},
          d.between(-10, 10),
          d.between(0, 60),
          d.between(-9, 5),
          d.between(-0.1, 0.1)};
}

} // namespace

TEST_CASE("a CAM gives a vehicle's motion back to within ETSI's units") {
  dice d{1};
  for (auto i = 0; i < 2000; ++i) {
    CAPTURE(i);
    const auto own = any_motion(d);
    const auto got = understood(make_cam(own, car, *in_ulm()), own.at + 30ms);
    REQUIRE(got);
    CHECK(got->station == own.station);
    CHECK(got->at == own.at);
    // Half a unit of latitude and longitude, and of the heading at the front.
    CHECK(distance_m(got->position, own.position) < 0.0105);
    CHECK(std::abs(wrap_angle(got->heading_rad - own.heading_rad))
          < 0.0501 * degree);
    CHECK(std::abs(got->speed_mps - own.speed_mps) < 0.00501);
    CHECK(std::abs(got->accel_mps2 - own.accel_mps2) < 0.0501);
    CHECK(std::abs(got->curvature_1pm - own.curvature_1pm) < 0.0000501);
  }
}

TEST_CASE("a CAM tells the middle of the front, the world the rear axle") {
  const cam own{101, start, {50, 20}, 30 * degree, 10, 0, 0};
  const auto message = make_cam(own, car, *in_ulm());
  const auto told =
      in_ulm()->frame.to_map(to_geo(message.body.parameters.basic.position));
  REQUIRE(told);
  CHECK(distance_m(*told, own.position) == near(car.front_m, 0.003));
  CHECK(distance_m(*told, front_of(own, car)) < 0.007);
}

TEST_CASE("of a longer car the rear axle is farther behind its front") {
  vehicle_params lorry;
  lorry.front_m *= 2;
  lorry.rear_m *= 2;
  const cam own{101, start, {50, 20}, 0, 10, 0, 0};
  const auto got = understood(make_cam(own, lorry, *in_ulm()));
  REQUIRE(got);
  CHECK(distance_m(got->position, own.position) < 0.0105);
}

TEST_CASE("what is faster than a CAM can say is as fast as it can say") {
  const cam own{101, start, {}, 0, 200, -30, 0.5};
  const auto got = understood(make_cam(own, car, *in_ulm()));
  REQUIRE(got);
  CHECK(got->speed_mps == near(163.82, 1e-9));
  CHECK(got->accel_mps2 == near(-16, 1e-9));
  CHECK(got->curvature_1pm == near(0.1022, 1e-9));
}

TEST_CASE("time is told modulo 65.536 s, and the nearest is meant") {
  dice d{2};
  for (auto i = 0; i < 500; ++i) {
    const auto own = any_motion(d);
    const auto message = make_cam(own, car, *in_ulm());
    for (const auto age : {-32s, -1s, 0s, 1s, 32s}) {
      const auto got = understood(message, own.at + age);
      REQUIRE(got);
      CHECK(got->at == own.at);
    }
    CHECK(understood(message, own.at + 33s)->at == own.at + 65536ms);
  }
}

TEST_CASE("whoever does not say where it is, which way it points or how fast "
          "it is has said nothing") {
  const auto good = make_cam({101, start, {}, 0, 10, 0, 0}, car, *in_ulm());
  REQUIRE(understood(good));
  auto nowhere = good;
  nowhere.body.parameters.basic.position.latitude =
      geo_position::unavailable_latitude;
  CHECK(!understood(nowhere));
  auto far_away = good;
  far_away.body.parameters.basic.position.longitude = 0;
  CHECK(!understood(far_away));
  auto aimless = good;
  motion_of(aimless).heading.value = etsi::unavailable_angle;
  CHECK(!understood(aimless));
  auto timeless = good;
  motion_of(timeless).speed.value =
      static_cast<std::uint16_t>(etsi::speed_mps.unavailable);
  CHECK(!understood(timeless));
}

TEST_CASE("what else is unavailable counts as nothing, and the size as ours") {
  const cam own{101, start, {10, 20}, 1, 10, 2, 0.05};
  auto message = make_cam(own, car, *in_ulm());
  auto& motion = motion_of(message);
  motion.acceleration.value =
      static_cast<std::int16_t>(etsi::accel_mps2.unavailable);
  motion.curvature.value =
      static_cast<std::int16_t>(etsi::curvature_1pm.unavailable);
  motion.length.value =
      static_cast<std::uint16_t>(etsi::vehicle_length_m.unavailable);
  const auto got = understood(message);
  REQUIRE(got);
  CHECK(got->accel_mps2 == 0);
  CHECK(got->curvature_1pm == 0);
  CHECK(distance_m(got->position, own.position) < 0.0105);
}

TEST_CASE("a vehicle that does not know its own motion says that it does not") {
  constexpr auto nan = std::numeric_limits<double>::quiet_NaN();
  auto message =
      sent(make_cam({101, start, {}, 0, nan, nan, nan}, car, *in_ulm()));
  CHECK(motion_of(message).speed.value == etsi::speed_mps.unavailable);
  CHECK(motion_of(message).acceleration.value == etsi::accel_mps2.unavailable);
  CHECK(motion_of(message).curvature.value == etsi::curvature_1pm.unavailable);
}

TEST_CASE("a roadside unit's CAM tells of no vehicle") {
  auto message = make_cam({101, start, {}, 0, 10, 0, 0}, car, *in_ulm());
  message.body.parameters.high_frequency.value.emplace<1>();
  CHECK(!understood(message));
}

TEST_CASE("the path history leads back where the vehicle has been, from the "
          "newest point to the oldest, each told from the newer one") {
  dice d{3};
  for (auto i = 0; i < 20; ++i) {
    CAPTURE(i);
    path_history been;
    cam own{101, start, {d.between(-500, 500), d.between(-500, 500)}, 0, 10};
    for (auto step = 0; step < 300; ++step) {
      own.at += 100ms;
      own.heading_rad += d.between(-0.1, 0.15);
      own.position =
          own.position
          + 1.0 * point{std::cos(own.heading_rad), std::sin(own.heading_rad)};
      been.pass(own.at, front_of(own, car));
    }
    REQUIRE(been.size() > 2);
    auto message = make_cam(own, car, *in_ulm());
    add_path(message, own, been, *in_ulm());
    const auto got = sent(message);
    CHECK(understood(message)); // it harms nothing
    const auto& low =
        std::get<0>(got.body.parameters.low_frequency.value().value);
    REQUIRE(low.path_history.size() == been.size());
    auto at = to_geo(got.body.parameters.basic.position);
    auto when = own.at;
    for (std::size_t k = 0; k < been.size(); ++k) {
      const auto& told = low.path_history[k];
      at.latitude += told.position.latitude.value;
      at.longitude += told.position.longitude.value;
      REQUIRE(told.before);
      when -= 10ms * told.before->value;
      const auto place = in_ulm()->frame.to_map(at);
      REQUIRE(place);
      // Errors do not add up from point to point.
      CHECK(distance_m(*place, been[k].at) < 0.007);
      CHECK(when == been[k].when);
    }
  }
}

TEST_CASE("who has only just begun to drive has been where it is") {
  const cam own{101, start, {}, 0, 10, 0, 0};
  path_history been;
  been.pass(own.at, front_of(own, car));
  auto message = make_cam(own, car, *in_ulm());
  CHECK(!sent(message).body.parameters.low_frequency);
  add_path(message, own, been, *in_ulm());
  const auto got = sent(message);
  REQUIRE(got.body.parameters.low_frequency);
  const auto& path =
      std::get<0>(got.body.parameters.low_frequency->value).path_history;
  REQUIRE(path.size() == 1);
  CHECK(path[0].position.latitude == 0);
  CHECK(path[0].position.longitude == 0);
  CHECK(path[0].before->value == 1); // the least that can be said
}

TEST_CASE("a point that the vehicle left long ago is as old as can be said") {
  cam own{101, start, {}, 0, 10, 0, 0};
  path_history been;
  for (auto i = 0; i < 10; ++i)
    been.pass(start + i * 1s, {10.0 * i, 0});
  own.at += 1h;
  own.position.x_m = 95;
  auto message = make_cam(own, car, *in_ulm());
  add_path(message, own, been, *in_ulm());
  const auto got = sent(message);
  const auto& path =
      std::get<0>(got.body.parameters.low_frequency->value).path_history;
  REQUIRE(path.size() > 0);
  CHECK(path[0].before->value == 65535);
}
