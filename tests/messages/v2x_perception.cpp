// What a CPM says of the bodies that a vehicle perceives, and what is
// understood of it.
#include "messages/etsi/units.hpp"
#include "messages/v2x/perception.hpp"
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

/// The CPM of TR 103 562.
struct release_1 {
  using message = etsi::tr103562::cpm;

  static message make(const perceived_scene& scene) {
    return make_cpm_tr103562(scene, car, *in_ulm());
  }
  static message sent(const message& x) {
    message got;
    REQUIRE(etsi::decode(encoded(x).view(), got));
    return got;
  }
  static std::optional<object_list> read(const message& x, time_point now) {
    return read_cpm(sent(x), *in_ulm(), now);
  }
};

/// From a scene to what somebody else knows of it.
std::optional<object_list> retold(const perceived_scene& scene,
                                  duration age = 30ms) {
  return release_1::read(release_1::make(scene), scene.own.at + age);
}

cam any_sender(dice& d) {
  return {101,
          start + std::chrono::milliseconds{std::lround(d.between(0, 1e7))},
          {d.between(-3000, 3000), d.between(-3000, 3000)},
          d.between(-10, 10),
          d.between(0, 30)};
}

perceived_object any_object(dice& d, point near) {
  return {near + point{d.between(-150, 150), d.between(-150, 150)},
          d.between(-10, 10),
          d.between(0, 60),
          d.between(-8, 4),
          d.between(0.3, 25),
          d.between(0.3, 4)};
}

perceived_object stander_at(point centre) {
  return {centre, 0, 0, 0, 4.5, 1.8};
}

} // namespace

TEST_CASE("a CPM gives what is perceived back to within ETSI's units") {
  dice d{1};
  for (auto i = 0; i < 300; ++i) {
    CAPTURE(i);
    const auto own = any_sender(d);
    std::vector<known_object> seen;
    for (std::uint32_t id = 0; id < 20; ++id)
      seen.push_back({id, any_object(d, own.position)});
    const auto got = retold({own, own.at, seen, seen.size()});
    REQUIRE(got);
    CHECK(got->from == own.station);
    CHECK(got->at == own.at);
    REQUIRE(got->objects.size() == seen.size());
    for (std::size_t k = 0; k < seen.size(); ++k) {
      const auto& was = seen[k].what;
      const auto& is = got->objects[k];
      CHECK(distance_m(is.centre, was.centre) < 0.0072); // 1 cm along each axis
      CHECK(std::abs(wrap_angle(is.heading_rad - was.heading_rad))
            < 0.0501 * degree);
      CHECK(std::abs(is.speed_mps - was.speed_mps) < 0.0072);
      CHECK(std::abs(is.accel_mps2 - was.accel_mps2) < 0.072);
      CHECK(std::abs(is.length_m - was.length_m) < 0.0501);
      CHECK(std::abs(is.width_m - was.width_m) < 0.0501);
    }
  }
}

TEST_CASE("objects are told from the middle of the sender's front, ahead and "
          "to the left") {
  const cam own{101, start, {50, 20}, 90 * degree, 10};
  const std::vector<known_object> seen{
      {7, {{48, 20 + car.front_m + 30}, 90 * degree, 5, 1, 4.5, 1.8}}};
  const auto message = release_1::sent(release_1::make({own, start, seen, 1}));
  REQUIRE(message.body.parameters.objects);
  const auto& x = (*message.body.parameters.objects)[0];
  CHECK(x.id == 7);
  CHECK(std::abs(x.x_distance.value - 3000) <= 3); // and the frame's rounding
  CHECK(std::abs(x.y_distance.value - 200) <= 3);
  CHECK(x.x_speed.value == 500);
  CHECK(std::abs(x.y_speed.value) <= 1);
  CHECK(x.planar_dimension_1->value == 45);
  CHECK(x.planar_dimension_2->value == 18);
}

TEST_CASE("objects are where they were when they were seen, not when that was "
          "told") {
  const cam own{101, start, {50, 20}, 0, 10};
  const std::vector<known_object> seen{{1, {{90, 20}, 0, 20, 0, 4.5, 1.8}}};
  for (const auto age : {0ms, 40ms, 1500ms}) {
    CAPTURE(age.count());
    const auto got = retold({own, start - age, seen, 1});
    REQUIRE(got);
    CHECK(got->at == start - age);
    CHECK(distance_m(got->objects[0].centre, {90, 20}) < 0.0072);
  }
}

TEST_CASE("what was seen at different times is brought to the last of them") {
  const cam own{101, start, {50, 20}, 0, 10};
  const std::vector<known_object> seen{{1, {{90, 20}, 0, 20, 0, 4.5, 1.8}},
                                       {2, stander_at({70, 30})}};
  auto message = release_1::make({own, start, seen, 2});
  (*message.body.parameters.objects)[0].time_of_measurement = 500;
  const auto got = release_1::read(message, start);
  REQUIRE(got);
  CHECK(got->at == start);
  CHECK(distance_m(got->objects[0].centre, {100, 20}) < 0.02);
  CHECK(distance_m(got->objects[1].centre, {70, 30}) < 0.0072);
}

TEST_CASE("a CPM's time is told modulo 65.536 s, and the nearest is meant") {
  dice d{2};
  for (auto i = 0; i < 300; ++i) {
    const auto own = any_sender(d);
    const std::vector<known_object> seen{{1, any_object(d, own.position)}};
    for (const auto age : {-32s, 0s, 32s}) {
      const auto got = retold({own, own.at - 40ms, seen, 1}, age);
      REQUIRE(got);
      CHECK(got->at == own.at - 40ms);
    }
  }
}

TEST_CASE("a body without size, heading or speed is none") {
  const cam own{101, start, {}, 0, 10};
  const std::vector<known_object> seen{{1, stander_at({30, 0})},
                                       {2, stander_at({40, 0})}};
  const auto good = release_1::make({own, start, seen, 2});
  REQUIRE(release_1::read(good, start)->objects.size() == 2);
  const auto without = [&](auto take_away) {
    auto message = good;
    take_away((*message.body.parameters.objects)[0]);
    const auto got = release_1::read(message, start);
    REQUIRE(got);
    REQUIRE(got->objects.size() == 1);
    CHECK(distance_m(got->objects[0].centre, {40, 0}) < 0.0072);
  };
  without([](auto& x) { x.planar_dimension_1.reset(); });
  without([](auto& x) { x.planar_dimension_2.reset(); });
  without([](auto& x) { x.planar_dimension_1->value = 0; });
  without([](auto& x) { x.yaw.reset(); });
  without([](auto& x) { x.yaw->value = etsi::unavailable_angle; });
  without([](auto& x) {
    x.x_speed.value = static_cast<std::int16_t>(etsi::velocity_mps.unavailable);
  });
}

TEST_CASE("who sees nobody says so") {
  const cam own{101, start, {}, 0, 10};
  const auto got = retold({own, start, {}, 0});
  REQUIRE(got);
  CHECK(got->from == 101);
  CHECK(got->at == start);
  CHECK(got->objects.empty());
}

TEST_CASE("a CPM says how many are perceived, also of those it leaves out") {
  const cam own{101, start, {}, 0, 10};
  const std::vector<known_object> seen{{1, stander_at({30, 0})}};
  const auto of = [&](std::size_t all) {
    return release_1::sent(release_1::make({own, start, seen, all}))
        .body.parameters.number_of_objects.value;
  };
  CHECK(of(1) == 1);
  CHECK(of(9) == 9);
  CHECK(of(1000) == 255); // as many as can be said
}

TEST_CASE("a CPM holds 128 objects, and all of them arrive") {
  const cam own{101, start, {}, 0, 10};
  std::vector<known_object> seen;
  for (std::uint32_t id = 0; id < cpm_trigger::most_objects; ++id)
    seen.push_back({id, stander_at({0.5 * id, 3})});
  const auto got = retold({own, start, seen, seen.size()});
  REQUIRE(got);
  REQUIRE(got->objects.size() == 128);
  CHECK(distance_m(got->objects[127].centre, {63.5, 3}) < 0.0072);
}

TEST_CASE("sensors are told of when asked, where they are and how far they "
          "see") {
  const cam own{101, start, {}, 0, 10};
  CHECK(!release_1::sent(release_1::make({own, start, {}, 0}))
             .body.parameters.sensors);
  sensor_params can;
  can.range_m = 80;
  can.field_of_view_deg = 120;
  const auto message =
      release_1::sent(release_1::make({own, start, {}, 0, &can}));
  REQUIRE(message.body.parameters.sensors);
  REQUIRE(message.body.parameters.sensors->size() == 1);
  const auto& mounted = std::get<etsi::tr103562::vehicle_sensor>(
      (*message.body.parameters.sensors)[0].detection_area.value);
  CHECK(mounted.x == -255); // half of 5.10 m behind the front
  REQUIRE(mounted.properties.size() == 1);
  CHECK(mounted.properties[0].range == 800);
  CHECK(mounted.properties[0].horizontal_start == 3000);
  CHECK(mounted.properties[0].horizontal_end == 600);
}

TEST_CASE("who reads a CPM of either release knows who looked, how far, and at "
          "how many") {
  const cam own{101, start, {50, 20}, 0.7, 10};
  const std::vector<known_object> seen{{7, stander_at({30, 0})},
                                       {300, stander_at({60, 0})}};
  sensor_params can;
  can.range_m = 80;
  can.field_of_view_deg = 120;
  const perceived_scene scene{own, start, seen, 5, &can};
  const auto check = [&](const std::optional<object_list>& got,
                         std::uint32_t last_id) {
    REQUIRE(got);
    CHECK(got->perceived == 5);
    CHECK(got->ids == std::vector<std::uint32_t>{7, last_id});
    CHECK(got->generated == start);
    REQUIRE(got->eye);
    CHECK(distance_m(got->eye->at, front_of(own, car)) < 0.02);
    CHECK(got->eye->heading_rad == near(0.7, 0.01));
    CHECK(got->eye->range_m == near(80, 1e-6));
    CHECK(got->eye->field_of_view_deg == near(120, 1e-6));
  };
  check(retold(scene), 300 % 256);
  check(read_cpm(make_cpm_ts103324(scene, car, *in_ulm()), *in_ulm()), 300);
}

TEST_CASE("a CPM of release 1 tells how fast its sender drives") {
  const cam own{101, start, {}, 0, 12.34};
  const auto message = release_1::make({own, start, {}, 0});
  CHECK(std::get<0>(message.body.parameters.station_data->value).speed.value
        == 1234);
}

TEST_CASE("a CPM without its sensors, or with several, tells of no range") {
  const cam own{101, start, {}, 0, 10};
  const auto silent = retold({own, start, {}, 0});
  REQUIRE(silent);
  REQUIRE(silent->eye);
  CHECK(silent->eye->range_m == 0);
  const sensor_params can;
  auto message = release_1::make({own, start, {}, 0, &can});
  auto& sensors = *message.body.parameters.sensors;
  sensors.push_back(sensors.front());
  const auto several = release_1::read(message, start);
  REQUIRE(several);
  CHECK(several->eye->range_m == 0);
}

TEST_CASE("who does not say where it is or which way it heads has seen "
          "nothing") {
  const cam own{101, start, {}, 0, 10};
  const auto good = release_1::make({own, start, {}, 0});
  auto nowhere = good;
  nowhere.body.parameters.management.position.latitude =
      geo_position::unavailable_latitude;
  CHECK(!release_1::read(nowhere, start));
  auto aimless = good;
  std::get<0>(aimless.body.parameters.station_data->value).heading.value =
      etsi::unavailable_angle;
  CHECK(!release_1::read(aimless, start));
  auto nobody = good;
  nobody.body.parameters.station_data.reset();
  CHECK(!release_1::read(nobody, start));
  auto roadside = good;
  roadside.body.parameters.station_data->value
      .emplace<etsi::tr103562::originating_roadside_unit>();
  CHECK(!release_1::read(roadside, start));
}
