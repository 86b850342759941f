// What many observers see becomes one track of each body.
#include "planners/scene/object_tracker.hpp"

#include "tests/planners/observed_road.hpp"
#include "tests/support/near.hpp"
#include "world/vehicle/vehicle.hpp"

#include <Eigen/LU>
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <numbers>

using namespace sofof;
using namespace sofof::test;

TEST_CASE("a body is known from its first sighting on") {
  object_tracker model;
  see(model, first_sight, perceived_car({3, 4}, 10, 1.2));
  REQUIRE(model.tracks().size() == 1);
  const auto& x = model.tracks()[0];
  CHECK(x.at == first_sight);
  CHECK(x.centre() == point{3, 4});
  CHECK(x.speed_along_mps(1.2) == test::near(10, 1e-12));
  CHECK(x.heading_rad == 1.2);
  CHECK(x.length_m == 5.1);
  CHECK(x.width_m == 1.89);
  CHECK_FALSE(x.station);
}

TEST_CASE("a standing body has a heading") {
  object_tracker model;
  for (auto i = 0; i < 20; ++i)
    see(model, first_sight + i * 100ms, perceived_car({}, 0, 2));
  CHECK(model.tracks()[0].body().heading_rad == test::near(2, 1e-9));
}

TEST_CASE("a body that turns across west keeps its heading") {
  object_tracker model;
  constexpr auto pi = std::numbers::pi;
  see(model, first_sight, perceived_car({}, 0, pi - 0.01));
  see(model, first_sight + 100ms, perceived_car({}, 0, -pi + 0.01));
  CHECK(std::abs(wrap_angle(model.tracks()[0].heading_rad - pi)) < 0.011);
}

TEST_CASE("a prediction is straight ahead, and less certain the longer") {
  object_tracker model;
  see(model, first_sight, perceived_car({}, 10, std::numbers::pi / 2));
  const auto& now = model.tracks()[0];
  const auto then = predict(now, first_sight + 1s);
  CHECK(distance_m(then.centre(), {0, 10}) < 1e-9);
  CHECK(then.at == first_sight + 1s);
  CHECK(then.motion.covariance(0, 0) > 10 * now.motion.covariance(0, 0));
  CHECK(predict(now, first_sight - 1s).centre() == now.centre());
}

TEST_CASE("predicting at once or in steps comes to the same") {
  motion_estimate once{Eigen::Matrix2d{{1, 2}, {3, 4}},
                       Eigen::Matrix2d{{0.2, 0.1}, {0.1, 0.3}}};
  auto often = once;
  once.advance(1);
  for (auto i = 0; i < 10; ++i)
    often.advance(0.1);
  CHECK(often.mean.isApprox(once.mean, 1e-12));
  CHECK(often.covariance.isApprox(once.covariance, 1e-12));
}

TEST_CASE("a filter of all four states comes to the same") {
  Eigen::Matrix2d p{{0.2, 0.1}, {0.1, 0.3}}, r{{0.1, 0}, {0, 0.2}};
  motion_estimate known{Eigen::Matrix2d{{1, 2}, {3, 4}}, p};
  const motion_estimate seen{Eigen::Matrix2d{{1.3, 2.1}, {2.8, 4.4}}, r};
  Eigen::Matrix4d p4 = Eigen::Matrix4d::Zero(), r4 = p4;
  for (auto axis = 0; axis < 2; ++axis)
    for (auto i = 0; i < 2; ++i)
      for (auto k = 0; k < 2; ++k) {
        p4(2 * i + axis, 2 * k + axis) = p(i, k);
        r4(2 * i + axis, 2 * k + axis) = r(i, k);
      }
  const Eigen::Vector4d x = known.mean.reshaped(), z = seen.mean.reshaped();
  const Eigen::Matrix4d gain = p4 * (p4 + r4).inverse();
  const Eigen::Vector4d expected = x + gain * (z - x);
  const auto distance2 = (z - x).dot((p4 + r4).inverse() * (z - x));
  CHECK(known.compare(seen).distance2 == test::near(distance2, 1e-12));
  known.fuse(seen);
  CHECK(known.mean.reshaped().isApprox(expected, 1e-12));
  const Eigen::Matrix4d left = p4 - gain * p4;
  CHECK(known.covariance(0, 1) == test::near(left(0, 2), 1e-12));
  CHECK(known.covariance(1, 1) == test::near(left(3, 3), 1e-12));
}

TEST_CASE("tracks are better than sightings, and know how good they are") {
  object_tracker model;
  observer eyes{1};
  auto sum2_m2 = 0.0, nees = 0.0;
  constexpr auto n = 1000;
  for (auto i = 0; i < n; ++i) {
    const auto t = i * 50ms;
    const point truth{15 * to_seconds(t), 0};
    see(model, first_sight + t, eyes.look(perceived_car(truth, 15)));
    const auto& x = model.tracks()[0];
    sum2_m2 += miss_m(x, truth) * miss_m(x, truth);
    const Eigen::Matrix2d off =
        x.motion.mean - Eigen::Matrix2d{{truth.x_m, 15}, {0, 0}};
    nees += (off * x.motion.covariance.inverse()).cwiseProduct(off).sum();
  }
  CHECK(model.tracks()[0].id == 1);
  CHECK(std::sqrt(sum2_m2 / n / 2) < 0.07); // each sighting: 0.1 m an axis
  CHECK(nees / n < 4); // 4 were exact; a car that never brakes is less
  CHECK(nees / n > 1);
}

TEST_CASE("two observers of a queue see each car once, and no two as one") {
  object_tracker model;
  observer a{1}, b{2};
  const queue street;
  for (auto t = first_sight; t < first_sight + 120s; t += 50ms) {
    model.update(t, a.look(street.at(t)));
    auto late = street.at(t - 20ms);
    std::ranges::reverse(late);
    model.update(t - 20ms, b.look(late));
    REQUIRE(model.tracks().size() == 8);
  }
  CHECK(ids(model) == std::set<std::uint32_t>{1, 2, 3, 4, 5, 6, 7, 8});
  const auto truth = street.at(first_sight + 120s - 50ms);
  for (std::size_t i = 0; i < truth.size(); ++i)
    CHECK(miss_m(model.tracks()[i], truth[i].centre) < 0.3);
}

TEST_CASE("occlusions in a queue neither merge nor split cars") {
  object_tracker model;
  observer eyes[]{observer{1}, observer{2}};
  const queue street;
  const random_stream dice{7, "occlusions"};
  for (auto i = 0; i < 2400; ++i) {
    const auto t = first_sight + i * 50ms;
    for (auto who = 0U; who < 2; ++who) {
      const auto all = street.at(t);
      std::vector<perceived_object> seen;
      for (auto k = 0U; k < all.size(); ++k)
        // For 0.4 s at a time.
        if (dice.uniform(static_cast<unsigned>(i) / 8, 8 * who + k) < 0.7)
          seen.push_back(eyes[who].look(all[k]));
      model.update(t, seen);
    }
    if (i > 40)
      REQUIRE(model.tracks().size() == 8);
    for (const auto& x : model.tracks())
      REQUIRE(std::ranges::any_of(street.at(t), [&](const auto& o) {
        return miss_m(x, o.centre) < 2.5;
      }));
  }
}

TEST_CASE("a car that brakes as hard as it can stays one track") {
  object_tracker model;
  observer eyes{1};
  for (auto t = 0.0; t < 4; t += 0.1) {
    const auto braked_s = std::clamp(t - 1, 0.0, 2.0);
    const point at{16 * std::min(t, 1.0) + braked_s * (16 - 4 * braked_s), 0};
    see(model, first_sight + from_seconds(t),
        eyes.look(perceived_car(at, 16 - 8 * braked_s)));
    REQUIRE(model.tracks().size() == 1);
    CHECK(miss_m(model.tracks()[0], at) < 0.6);
  }
  CHECK(model.tracks()[0].id == 1);
}

TEST_CASE("a car in a tight bend stays one track") {
  object_tracker model;
  observer eyes{1};
  const vehicle_params ability;
  vehicle_state x;
  x.speed_mps = 6;
  x.steer_rad = std::atan(ability.wheelbase_m / 10);
  for (auto i = 0; i < 300; ++i) {
    x = step(x, {0, x.steer_rad}, ability, 0.05);
    const auto box = body(x, ability);
    see(model, first_sight + i * 50ms,
        eyes.look(perceived_car(box.centre, x.speed_mps, x.heading_rad)));
    REQUIRE(model.tracks().size() == 1);
    CHECK(miss_m(model.tracks()[0], box.centre) < 0.5);
    CHECK(std::abs(wrap_angle(model.tracks()[0].heading_rad - x.heading_rad))
          < 0.1);
  }
}

TEST_CASE("cars that pass each other in a narrow street keep their tracks") {
  object_tracker model;
  observer eyes{1};
  for (auto t = 0.0; t < 4; t += 0.1) {
    std::vector seen{perceived_car({-30 + 15 * t, 0}, 15),
                     perceived_car({30 - 15 * t, 2.3}, 15, std::numbers::pi)};
    model.update(first_sight + from_seconds(t), eyes.look(seen));
  }
  REQUIRE(model.tracks().size() == 2);
  CHECK(model.tracks()[0].centre().x_m > 28);
  CHECK(model.tracks()[1].centre().x_m < -28);
}

TEST_CASE("a heading that is told rarely is believed at once") {
  object_tracker model{{}, rhythm};
  see(model, first_sight, perceived_car({}, 5, 0));
  see(model, first_sight + 800ms, perceived_car({4, 0.1}, 5, 0.07));
  CHECK(model.tracks()[0].heading_rad == test::near(0.07, 1e-9));
  see(model, first_sight + 900ms, perceived_car({4.5, 0.14}, 5, 0.09));
  CHECK(model.tracks()[0].heading_rad == test::near(0.08, 1e-9));
}

TEST_CASE("a body that comes back from an occlusion is the same") {
  object_tracker model;
  see(model, first_sight, perceived_car({}, 10));
  see(model, first_sight + 900ms, perceived_car({8.5, 0.3}, 9));
  REQUIRE(model.tracks().size() == 1);
  CHECK(model.tracks()[0].id == 1);
}

TEST_CASE("a body is where it is, however fast it was said to be") {
  object_tracker model;
  see(model, first_sight, perceived_car({}, 10));
  see(model, first_sight + 50ms, perceived_car({1, 0}, 0, 1));
  REQUIRE(model.tracks().size() == 1);
  CHECK(model.tracks()[0].centre() == point{1, 0});
  CHECK(model.tracks()[0].speed_along_mps(0) == 0);
}

TEST_CASE("two bodies side by side are two from the first sight on") {
  object_tracker model;
  const std::vector seen{perceived_car({}), perceived_car({0, 2}),
                         perceived_car({5.2, 0})};
  model.update(first_sight, seen);
  CHECK(model.tracks().size() == 3);
  model.update(first_sight + 100ms, seen);
  CHECK(model.tracks().size() == 3);
}

TEST_CASE("whoever stands a length ahead of an occluded car is another") {
  object_tracker model;
  see(model, first_sight, perceived_car({}));
  see(model, first_sight + 900ms, perceived_car({8, 0}));
  CHECK(model.tracks().size() == 2);
}

TEST_CASE("a vague idea of one body does not claim the sighting of another") {
  object_tracker model;
  auto bicycle = [](double x_m, double speed_mps) {
    return perceived_object{{x_m, 0}, 0, speed_mps, 0, 1.8, 0.6};
  };
  const std::vector both{bicycle(0, 5), bicycle(3, 0)}; // the second vanishes
  model.update(first_sight, both);
  for (auto t = 0.1; t < 0.85; t += 0.1)
    see(model, first_sight + from_seconds(t), bicycle(5 * t, 5));
  see(model, first_sight + 900ms,
      bicycle(4.75, 4.5)); // 0.25 m farther than expected
  REQUIRE(model.tracks().size() == 2);
  CHECK(model.tracks()[0].seen == first_sight + 900ms);
  CHECK(model.tracks()[1].seen == first_sight);
}

TEST_CASE("a vehicle that is heard gives its track its name") {
  object_tracker model;
  const std::vector seen{perceived_car({}, 10), perceived_car({8, 0}, 10)};
  model.update(first_sight, seen);
  model.on_report(first_sight + 20ms, 77, perceived_car({8.2, 0}, 10));
  REQUIRE(model.tracks().size() == 2);
  CHECK_FALSE(model.tracks()[0].station);
  CHECK(model.tracks()[1].station == 77U);
  model.on_report(first_sight + 40ms, 78,
                  perceived_car({-20, 0}, 10)); // nobody has seen it
  REQUIRE(model.tracks().size() == 3);
  CHECK(model.tracks()[2].station == 78U);
}

TEST_CASE("a name is nobody else's") {
  object_tracker model;
  model.on_report(first_sight, 1, perceived_car({}, 10));
  model.on_report(first_sight, 2,
                  perceived_car({0.5, 0}, 10)); // the inscribed circles overlap
  CHECK(model.tracks().size() == 2);
  model.on_report(first_sight + 100ms, 1,
                  perceived_car({60, 0}, 10)); // was mistaken for another
  REQUIRE(model.tracks().size() == 3);
  CHECK_FALSE(model.tracks()[0].station);
  CHECK(model.tracks()[1].station == 2U);
  CHECK(model.tracks()[2].station == 1U);
}

TEST_CASE("what no body can be is left out") {
  constexpr auto nan = std::numeric_limits<double>::quiet_NaN();
  object_tracker model;
  std::vector wrong(13, perceived_car({}));
  wrong[0].centre.x_m = nan;
  wrong[1].heading_rad = std::numeric_limits<double>::infinity();
  wrong[2].speed_mps = nan;
  wrong[3].speed_mps = 1e300;
  wrong[4].width_m = 0;
  wrong[5].length_m = 1e9;
  wrong[6].centre.x_m = 1e300;
  wrong[7].centre.y_m = -2e7;
  wrong[8].heading_rad = 2e6;
  wrong[9].heading_rad = nan;
  wrong[10].width_m = 61;
  wrong[11].length_m = 0;
  wrong[12].width_m = 1e-300; // a mean with it may be 0
  model.update(first_sight, wrong);
  for (const auto& o : wrong)
    model.on_report(first_sight, 1, o);
  CHECK(model.tracks().empty());
}

TEST_CASE(
    "a body of any shape is tracked as one, whatever it is wider or longer "
    "than") {
  for (const auto& [length_m, width_m] :
       {std::pair{0.1, 50.0}, {50.0, 0.1}, {2.0, 8.0}, {0.1, 0.1}}) {
    CAPTURE(length_m);
    observer eyes{7};
    object_tracker model;
    const perceived_object o{{20, 5}, 0.3, 0, 0, length_m, width_m};
    for (int k = 0; k < 40; ++k)
      model.update(first_sight + k * 50ms, std::vector{eyes.look(o)});
    REQUIRE(model.tracks().size() == 1);
    CHECK(model.tracks()[0].length_m == test::near(length_m, 1e-9));
    CHECK(model.tracks()[0].width_m == test::near(width_m, 1e-9));
    CHECK(distance_m(model.tracks()[0].centre(), o.centre) < 0.2);
  }
}

TEST_CASE("nobody can tell of more bodies at once than a road shows") {
  object_tracker model;
  std::vector<perceived_object> crowd(256, perceived_car({500, 0}));
  crowd.push_back(perceived_car({}));
  model.update(first_sight, crowd);
  REQUIRE_FALSE(model.tracks().empty());
  for (const auto& x : model.tracks())
    CHECK(x.centre() == point{500, 0});
}

TEST_CASE("who was not seen for longest makes room when there are too many") {
  object_tracker model;
  see(model, first_sight, perceived_car({-50, 0}));
  for (auto i = 0; i < 1100; ++i)
    see(model, first_sight + 10ms, perceived_car({10.0 * i, 0}));
  CHECK(model.tracks().size() == 1024);
  CHECK(model.tracks().front().id != 1);
  CHECK(model.tracks().back().id == 1101);
}

TEST_CASE("the order in which an observer lists bodies does not matter") {
  object_tracker a, b;
  observer eyes{1};
  const queue street;
  a.update(first_sight, street.at(first_sight));
  b.update(first_sight, street.at(first_sight));
  for (auto i = 1; i < 100; ++i) {
    auto seen = eyes.look(street.at(first_sight + i * 50ms));
    a.update(first_sight + i * 50ms, seen);
    std::ranges::reverse(seen);
    b.update(first_sight + i * 50ms, seen);
  }
  for (std::size_t i = 0; i < 8; ++i)
    CHECK(a.tracks()[i].motion.mean == b.tracks()[i].motion.mean);
}
