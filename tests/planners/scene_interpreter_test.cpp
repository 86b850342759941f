// What tracks mean to one vehicle: who leads, and who stands in the lane.
#include "planners/scene/scene_interpreter.hpp"

#include "base/random.hpp"
#include "tests/planners/onlooker.hpp"
#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace sofof;
using namespace sofof::planners;
using namespace sofof::test;
using namespace sofof::world;
using std::numbers::pi;
using namespace std::chrono_literals;

TEST_CASE("an empty road means nothing to a driver") {
  auto o = on_street();
  o.seen.stop_at_m = 77;
  o.seen.lead = lead_vehicle{};
  o.seen.crossings.resize(3);
  o.seen.beside.resize(3);
  o.look({});
  CHECK(o.seen.at == look_time);
  CHECK_FALSE(o.seen.lead);
  CHECK(o.seen.crossings.empty());
  CHECK(o.seen.beside.empty());
  CHECK(o.seen.stop_at_m == 77); // nobody's business here
}

TEST_CASE("the nearest car ahead leads, seen at its rear") {
  auto o = ten_metres_down_the_street();
  auto slow = seen_track({80, 0}, 0, 5);
  slow.accel_mps2 = -2;
  slow.station = 12;
  const auto& seen =
      o.look({seen_track({120, 0}), slow, seen_track({5, 0}, 0, 10)});
  REQUIRE(seen.lead);
  CHECK(seen.lead->rear_s_m == test::near(80 - 2.55, 1e-6));
  CHECK(seen.lead->speed_mps == test::near(5, 1e-9));
  CHECK(seen.lead->accel_mps2 == -2);
  CHECK(seen.lead->station == 12);
  CHECK(seen.beside.empty());
}

TEST_CASE("tracks are brought to the present") {
  auto o = ten_metres_down_the_street();
  auto x = seen_track({80, 0}, 0, 10);
  x.at = look_time - 200ms;
  CHECK(o.look({x}).lead->rear_s_m == test::near(82 - 2.55, 1e-6));
}

TEST_CASE("a lead that speeds up is not expected to go on") {
  auto o = ten_metres_down_the_street();
  auto x = seen_track({80, 0}, 0, 10);
  x.accel_mps2 = 2;
  CHECK(o.look({x}).lead->accel_mps2 == 0);
}

TEST_CASE("who comes towards one counts as standing") {
  auto o = ten_metres_down_the_street();
  auto x = seen_track({80, 0.2}, pi, 10);
  x.accel_mps2 = -3;
  const auto& seen = o.look({x});
  REQUIRE(seen.lead);
  CHECK(seen.lead->speed_mps == 0);
  CHECK(seen.lead->accel_mps2 == 0);
}

TEST_CASE("a body across the lane leads with its near side") {
  auto o = ten_metres_down_the_street();
  const auto& seen = o.look({seen_track({80, 0}, pi / 2, 4)});
  REQUIRE(seen.lead);
  CHECK(seen.lead->rear_s_m == test::near(80 - 0.945, 1e-6));
  CHECK(seen.lead->speed_mps < 1e-9);
}

TEST_CASE("a body that is wider than long is seen along all its width") {
  auto o = ten_metres_down_the_street();
  auto wall = seen_track({80, -1.25});
  wall.length_m = 0.5;
  wall.width_m = 6; // up to 1.75 m to the left
  const auto& seen = o.look({wall});
  REQUIRE(seen.lead);
  CHECK(seen.lead->rear_s_m == test::near(79.75, 1e-6));
  wall.motion.mean(1, 0) = -4.25; // up to 1.25 m to the right: it leaves 3 m
  o.look({wall});
  CHECK_FALSE(seen.lead);
  REQUIRE(seen.beside.size() == 1);
  CHECK(seen.beside[0].high_m == test::near(-1.25, 1e-6));
  CHECK(seen.beside[0].low_m == test::near(-7.25, 1e-6));
}

TEST_CASE("a body of 50 m leads with its near end") {
  auto o = ten_metres_down_the_street();
  auto convoy = seen_track({80, 0});
  convoy.length_m = 50;
  const auto& seen = o.look({convoy});
  REQUIRE(seen.lead);
  CHECK(seen.lead->rear_s_m == test::near(55, 1e-6));
}

TEST_CASE("whoever is behind, or farther than one looks, does not lead") {
  auto o = ten_metres_down_the_street();
  CHECK_FALSE(o.look({seen_track({5, 0}, 0, 30)}).lead);
  CHECK_FALSE(o.look({seen_track({219, 0})}).lead);
  CHECK(o.look({seen_track({216, 0})}).lead);
}

TEST_CASE("a car beside oneself leads once its nose is ahead of the own one") {
  auto o = ten_metres_down_the_street();
  CHECK_FALSE(o.look({seen_track({11.2, 2}, -0.4)}).lead);
  CHECK(o.look({seen_track({13, 2}, -0.4)}).lead);
}

TEST_CASE("who leaves room in the lane is beside, who does not leads") {
  auto o = ten_metres_down_the_street();
  // Of 3.5 m the own car needs 2.42 m: 1.08 m are free, 0.1 m less once it has
  // found room.
  std::uint32_t id = 0;
  const auto other = [&](double beside_m, double speed_mps = 0) {
    auto x = seen_track({60, beside_m}, 0, speed_mps);
    x.id = ++id;
    return x;
  };
  for (const auto side : {-1.0, 1.0}) {
    o.look({other(side * (0.68 + 0.945), 2)});
    CHECK_FALSE(o.seen.lead);
    REQUIRE(o.seen.beside.size() == 1);
    const auto& b = o.seen.beside[0];
    CHECK(b.from_m == test::near(60 - 2.55, 1e-6));
    CHECK(b.to_m == test::near(60 + 2.55, 1e-6));
    CHECK(std::min(std::abs(b.low_m), std::abs(b.high_m))
          == test::near(0.68, 1e-6));
    CHECK(b.low_m * side > 0);
    CHECK(b.speed_mps == test::near(2, 1e-9));
    o.look({other(side * (0.66 + 0.945))});
    CHECK(o.seen.lead);
    CHECK(o.seen.beside.empty());
    o.look({seen_track({60, side * (1.76 + 0.945)})});
    CHECK_FALSE(o.seen.lead);
    CHECK(o.seen.beside.empty());
  }
}

TEST_CASE(
    "who has left room is beside with a little less, too, and with as much "
    "as the body needs when there is no way to stop any more") {
  const auto is_beside = [](double speed_mps, double beside_m) {
    auto o = ten_metres_down_the_street();
    o.me.speed_mps = speed_mps;
    auto x = seen_track({34, 0.7 + 0.945});
    o.look({x});
    REQUIRE(o.seen.beside.size() == 1);
    CHECK(o.seen.beside[0].lacks_m < 1e-3);
    x.motion.mean(1, 0) = beside_m + 0.945;
    o.look({x});
    return !o.seen.beside.empty() && o.seen.beside[0].lacks_m > 1e-3;
  };
  CHECK(is_beside(5, 0.6));
  CHECK_FALSE(is_beside(5, 0.55));
  CHECK(is_beside(13.9, 0.45));
  CHECK_FALSE(is_beside(13.9, 0.25));
}

TEST_CASE("those beside come in order, as far as the lead") {
  auto o = ten_metres_down_the_street();
  o.look({seen_track({90, 1.9}, pi, 7), seen_track({60, -1.9}),
          seen_track({110, 0}), seen_track({130, 1.9})});
  REQUIRE(o.seen.beside.size() == 2);
  CHECK(o.seen.beside[0].from_m < o.seen.beside[1].from_m);
  CHECK(o.seen.beside[1].speed_mps == test::near(-7, 1e-9));
  CHECK(o.seen.lead->rear_s_m == test::near(110 - 2.55, 1e-6));
}

TEST_CASE("one is not in one's own way") {
  auto o = ten_metres_down_the_street();
  o.me.d_m = 0.3;
  const auto self = seen_track({10 + 1.4675, 0.3}, 0, 10);
  CHECK_FALSE(o.look({self}).lead);
  auto late = self; // and its place is not well known
  late.motion.mean(0, 0) += 6;
  CHECK(o.look({late}).lead);
  late.station = 5;
  CHECK(o.look({late}).lead);
  o.me.station = 5;
  CHECK_FALSE(o.look({late}).lead);
}

TEST_CASE("a cyclist on the centre line leads, one at the kerb is beside") {
  auto o = ten_metres_down_the_street();
  auto x = seen_track({50, 0}, 0, 5);
  x.length_m = 1.8;
  x.width_m = 0.6;
  CHECK(o.look({x}).lead);
  x.motion.mean(1, 0) = -1.3;
  CHECK_FALSE(o.look({x}).lead);
  CHECK(o.look({x}).beside.size() == 1);
}

TEST_CASE("Lehr: the car ahead leads, everywhere and in every lap") {
  for (const auto& name : round_trips) {
    CAPTURE(name);
    onlooker o{lehr().map, lehr().route(name)};
    for (const auto lap : {0, 3})
      for (auto s_m = 0.0; s_m < o.way->length_m(); s_m += 7) {
        o.me.s_m = s_m + lap * o.way->length_m();
        const auto axle_m = o.me.s_m + 30;
        const auto& seen = o.look({on_way(*o.way, axle_m, 8)});
        REQUIRE(seen.lead);
        CHECK(std::abs(seen.lead->rear_s_m - (axle_m - car_params.rear_m))
              < 0.1); // corners, in bends
        CHECK(std::abs(seen.lead->speed_mps - 8) < 0.4);
      }
  }
}

TEST_CASE("Lehr: oncoming traffic in its lane is nobody's business") {
  for (auto i = 0; i < 2; ++i) {
    onlooker o{lehr().map, lehr().route(round_trips[i])};
    const auto back = lehr().route(round_trips[1 - i]);
    std::vector<track> oncoming;
    for (auto s_m = 0.0; s_m < back->length_m(); s_m += 3)
      oncoming.push_back(on_way(*back, s_m, 8));
    for (auto s_m = 0.0; s_m < o.way->length_m(); s_m += 20) {
      o.me.s_m = s_m;
      const auto& seen = o.look(oncoming);
      CHECK_FALSE(seen.lead);
      CHECK(seen.beside.empty());
    }
  }
}

TEST_CASE("Lehr: nor when it is seen with noise") {
  const random_stream dice{3, "noise"};
  onlooker o{lehr().map, lehr().route(round_trips[0])};
  const auto back = lehr().route(round_trips[1]);
  std::vector<track> oncoming;
  for (auto s_m = 0.0; s_m < back->length_m(); s_m += 3) {
    auto x = on_way(*back, s_m, 8);
    const auto n = oncoming.size();
    x.motion.mean(0, 0) += dice.normal(0, 0.1, n, 0);
    x.motion.mean(1, 0) += dice.normal(0, 0.1, n, 1);
    x.heading_rad += dice.normal(0, 0.01, n, 2);
    oncoming.push_back(x);
  }
  for (auto s_m = 0.0; s_m < o.way->length_m(); s_m += 20) {
    o.me.s_m = s_m;
    CHECK_FALSE(o.look(oncoming).lead);
  }
}

TEST_CASE("Lehr: in tight bends, whatever reaches into the lane is found") {
  const random_stream dice{11, "bodies"};
  auto reaching = 0;
  for (const auto& name : round_trips) {
    onlooker o{lehr().map, lehr().route(name)};
    const auto& line = o.way->path();
    const auto bend_m = line.project({-420, -132}).s_m; // the roundabout
    o.me.s_m = bend_m - 80;
    for (auto n = 0U; n < 1000; ++n) {
      const auto here = line.at(bend_m + dice.uniform(-40, 40, n, 0));
      const auto left_m = dice.uniform(-6, 6, n, 1);
      auto x = seen_track(here.at
                              + left_m
                                    * point{-std::sin(here.heading_rad),
                                            std::cos(here.heading_rad)},
                          here.heading_rad + dice.uniform(-pi, pi, n, 2));
      x.id = n + 1;
      x.length_m = dice.uniform(2, 12, n, 3);
      auto nearest_m = 1e9; // of its outline
      const auto box = x.body();
      const point ahead{std::cos(box.heading_rad), std::sin(box.heading_rad)};
      const point left{-ahead.y_m, ahead.x_m};
      for (auto i = -40; i <= 40; ++i)
        for (auto k = -8; k <= 8; ++k)
          nearest_m = std::min(
              nearest_m,
              std::abs(line.project(box.centre
                                        + (i / 80.0) * box.length_m * ahead
                                        + (k / 16.0) * box.width_m * left,
                                    bend_m, 70)
                           .d_m));
      const auto& seen = o.look({x});
      const auto is_found = seen.lead || !seen.beside.empty();
      if (nearest_m > 1.76)
        CHECK_FALSE(is_found);
      if (nearest_m < 1.65) // between measured points, sides bulge
        CHECK(is_found);
      if (nearest_m < 0.6)
        CHECK(seen.lead);
      reaching += is_found ? 1 : 0;
    }
  }
  CHECK(reaching > 600);
  CHECK(reaching < 1900);
}

TEST_CASE("Lehr: a long body beside a bend is as wide all the way past it") {
  constexpr auto length_m = 26.0, width_m = 2.0;
  onlooker o{lehr().map, lehr().route(round_trips[0])};
  const auto& line = o.way->path();
  auto looks = 0;
  for (auto s_m = 60.0; s_m < line.length_m() - 60; s_m += 35) {
    CAPTURE(s_m);
    const auto here = line.at(s_m);
    const point left{-std::sin(here.heading_rad), std::cos(here.heading_rad)};
    auto x = seen_track(here.at + -2.3 * left, here.heading_rad);
    x.length_m = length_m;
    x.width_m = width_m;
    std::optional<double> high_m;
    for (o.me.s_m = s_m - 25; o.me.s_m < s_m + 13; o.me.s_m += 0.9) {
      o.look({x});
      if (o.seen.lead || o.seen.beside.size() != 1)
        continue; // the bend leaves no room
      ++looks;
      high_m = high_m.value_or(o.seen.beside[0].high_m);
      REQUIRE(std::abs(o.seen.beside[0].high_m - *high_m) < 0.02);
    }
  }
  CHECK(looks > 300);
}
