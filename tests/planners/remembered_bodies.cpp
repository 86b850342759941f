// How long a body is remembered that nobody sees, and what is told late of it.
#include "planners/scene/object_tracker.hpp"
#include "tests/planners/observed_road.hpp"
#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace sofof;
using namespace sofof::test;

TEST_CASE("sightings that arrive in the wrong order are of the same car") {
  object_tracker orderly, late;
  observer a{1}, b{2}, again_a{1}, again_b{2};
  auto truth = [](time_point t) {
    return perceived_car({12 * to_seconds(t - first_sight), 0}, 12);
  };
  auto t = first_sight;
  for (auto i = 0; i < 100; ++i, t += 100ms) {
    see(orderly, t - 300ms, b.look(truth(t - 300ms)));
    see(orderly, t, a.look(truth(t)));
    see(late, t, again_a.look(truth(t)));
    see(late, t - 300ms, again_b.look(truth(t - 300ms)));
    CHECK(late.tracks().size() == 1);
    CHECK(late.tracks()[0].at == t);
  }
  t -= 100ms;
  CHECK(miss_m(late.tracks()[0], truth(t).centre) < 0.2);
  CHECK(miss_m(orderly.tracks()[0], truth(t).centre) < 0.2);
}

TEST_CASE("an old sighting tells little, and nothing about heading") {
  object_tracker model;
  see(model, first_sight, perceived_car({}, 10));
  const auto before = model.tracks()[0];
  see(model, first_sight - 300ms,
      perceived_car({-2.7, 0}, 10, 0.03)); // 0.3 m ahead
  const auto& after = model.tracks()[0];
  REQUIRE(model.tracks().size() == 1);
  CHECK(after.heading_rad == before.heading_rad);
  CHECK(after.centre().x_m > 0.01);
  CHECK(after.centre().x_m < 0.15);
  CHECK(after.seen == first_sight);
}

TEST_CASE("a new body may be told of late") {
  object_tracker model;
  see(model, first_sight, perceived_car({}, 10));
  see(model, first_sight - 300ms, perceived_car({50, 0}, 10));
  REQUIRE(model.tracks().size() == 2);
  CHECK(model.tracks()[1].at == first_sight);
  CHECK(model.tracks()[1].centre().x_m == test::near(53, 1e-9));
  CHECK(model.tracks()[1].seen == first_sight - 300ms);
}

TEST_CASE("ancient sightings are dropped") {
  object_tracker model;
  see(model, first_sight, perceived_car({}, 10));
  see(model, first_sight - 600ms, perceived_car({50, 0}, 10));
  CHECK(model.tracks().size() == 1);
  model.on_report(first_sight - 600ms, 5, perceived_car({80, 0}));
  CHECK(model.tracks().size() == 1);
}

TEST_CASE("a body is remembered for a second without sightings") {
  object_tracker model;
  see(model, first_sight, perceived_car({}, 10));
  model.update(first_sight + 1s, {});
  REQUIRE(model.tracks().size() == 1);
  CHECK(model.tracks()[0].centre().x_m == test::near(10, 1e-9));
  model.update(first_sight + 1001ms, {});
  CHECK(model.tracks().empty());
}

TEST_CASE(
    "a car that comes is remembered for four seconds by its only observer "
    "while another one stands in between") {
  constexpr point eye{0, 0};
  const auto is_known_after = [&](duration unseen, point between) {
    object_tracker model;
    const auto stands = perceived_car(between, 0, std::numbers::pi / 2);
    model.update(
        first_sight,
        std::vector{perceived_car({60, 0}, 10, std::numbers::pi), stands}, eye);
    for (auto t = 100ms; t <= unseen; t += 100ms)
      model.update(first_sight + t, std::vector{stands}, eye);
    return model.tracks().size() == 2;
  };
  CHECK(is_known_after(1s, {10, 4}));
  CHECK_FALSE(is_known_after(1100ms, {10, 4})); // it would be seen there
  CHECK(is_known_after(4s, {10, 0}));
  CHECK_FALSE(is_known_after(4100ms, {10, 0}));
}

TEST_CASE("a body that is told of once a second outlives a lost message") {
  object_tracker model{{}, rhythm};
  see(model, first_sight, perceived_car({}));
  see(model, first_sight + 2100ms,
      perceived_car({})); // one was lost, the next one is late
  REQUIRE(model.tracks().size() == 1);
  CHECK(model.tracks()[0].id == 1);
}

TEST_CASE("a body that moves is expected back sooner than one that stands") {
  object_tracker model{{}, rhythm};
  model.update(first_sight,
               std::vector{perceived_car({}), perceived_car({0, 50}, 5),
                           perceived_car({0, 99}, 40)});
  model.update(first_sight + 1s, {});
  CHECK(model.tracks().size() == 3);
  model.update(first_sight + 2s, {}); // 40 m/s: after 1 s, as from sensors
  CHECK(ids(model) == std::set<std::uint32_t>{1, 2});
  model.update(first_sight + 2200ms,
               {}); // 5 m/s: twice 0.8 s and half a second
  CHECK(ids(model) == std::set<std::uint32_t>{1});
  model.update(first_sight + 2500ms, {});
  CHECK(model.tracks().size() == 1);
  model.update(first_sight + 2600ms, {});
  CHECK(model.tracks().empty());
}

TEST_CASE("who tells of bodies at every look is silent at no speed") {
  for (const auto speed_mps : {0.0, 3.0, -3.0, 1e300})
    CHECK(sighting_rhythm{}.silence(speed_mps) == 0s);
  CHECK(rhythm.silence(0) == 1s);
  CHECK(rhythm.silence(-8) == 500ms);
  constexpr auto nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(rhythm.silence(nan) == 1s);
}

TEST_CASE("a queue that is told of by the rules is neither merged nor split") {
  object_tracker model{{}, rhythm};
  observer eyes{1};
  const queue street;
  std::vector<perceived_object> told;
  std::vector<time_point> when;
  for (auto t = first_sight; t < first_sight + 60s; t += 100ms) {
    const auto all = street.at(t);
    if (t == first_sight)
      told = all, when.assign(all.size(), first_sight - 1s);
    std::vector<perceived_object> news;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (distance_m(told[i].centre, all[i].centre) > 4
          || std::abs(told[i].speed_mps - all[i].speed_mps) > 0.5
          || t - when[i] >= 1s) {
        news.push_back(eyes.look(all[i]));
        told[i] = all[i], when[i] = t;
      }
    model.update(t, news);
    REQUIRE(model.tracks().size() == 8);
    for (std::size_t i = 0; i < all.size(); ++i)
      REQUIRE(miss_m(model.tracks()[i], all[i].centre) < 1);
  }
  CHECK(ids(model) == std::set<std::uint32_t>{1, 2, 3, 4, 5, 6, 7, 8});
}
