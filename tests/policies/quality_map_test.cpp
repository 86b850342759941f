// What is learned of places, and what is foreseen by it.
#include "policies/algorithms/forecast/quality_map.hpp"

#include "policies/algorithms/forecast/learned_forecast.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <memory>
#include <vector>

using namespace sofof;
using namespace sofof::policies;

namespace {

constexpr std::string_view map_service = "planning";

seen_quality result(double x_m, bool late = false, double latency_s = 0.02) {
  return {1, map_service, {x_m, 0}, late ? 0.08 : latency_s, late, false};
}

seen_quality offer(double x_m, bool late = false) {
  return {1, map_service, {x_m, 0}, late ? 0.08 : 0.02, late, true};
}

/// A vehicle that learns for itself, in cells of 10 m.
struct learning_vehicle {
  std::shared_ptr<quality_map> map = std::make_shared<quality_map>();
  learned_forecast forecast{map};

  double late(double x_m) const {
    return forecast.look(1, map_service, {x_m, 0}).late;
  }
  void drive(double from_m, double to_m, double late_from_m = 1e9) {
    for (auto x_m = from_m; x_m < to_m; x_m += 0.5)
      forecast.learn(result(x_m, x_m >= late_from_m));
  }
};

} // namespace

TEST_CASE("an empty map knows what was thought before") {
  const quality_map map{{.prior_visits = 2, .prior_late = 0.02}};
  CHECK(map.late(map_service, 1, {0, 0}) == doctest::Approx(0.02));
  CHECK(map.at(map_service, 1, {0, 0}) == cell_quality{});
  CHECK(map.entries().empty());
}

TEST_CASE("cells are half open squares, also west and south of the origin") {
  const quality_map map{{.cell_m = 10}};
  CHECK(map.cell_of({0, 9.99}) == map_cell{0, 0});
  CHECK(map.cell_of({10, -0.01}) == map_cell{1, -1});
  CHECK(map.cell_of({-10, -10.01}) == map_cell{-1, -2});
  const auto inf = std::numeric_limits<double>::infinity();
  CHECK(map.cell_of({inf, -inf}) == map.cell_of({1e300, -1e300}));
}

TEST_CASE("probabilities stay probabilities, whatever is learned") {
  test::dice random{3};
  quality_map map{{.memory = 5}};
  for (int k = 0; k < 2000; ++k) {
    const auto visits = random.between(0, 8);
    map.add(map_service, 1, {0, 0},
            {visits, random.between(0, visits), random.between(0, 1)});
    const auto p = map.late(map_service, 1, {0, 0});
    CHECK(p >= 0);
    CHECK(p <= 1);
    const auto known = map.at(map_service, 1, {0, 0});
    CHECK(known.visits <= 5 + 1e-9);
    CHECK(known.latency_s <= 1);
  }
}

TEST_CASE("more late results never make a place look better, nor more in time "
          "worse") {
  test::dice random{5};
  for (int round = 0; round < 300; ++round) {
    quality_map map{{.memory = random.between(1, 30)}};
    for (int k = 0; k < 40; ++k) {
      const auto before = map.late(map_service, 1, {0, 0});
      const auto weight = random.between(0.01, 1);
      const auto late = random.between(0, 1) < 0.5;
      map.add(map_service, 1, {0, 0}, {weight, late ? weight : 0, 0});
      const auto after = map.late(map_service, 1, {0, 0});
      CHECK((late ? after >= before - 1e-12 : after <= before + 1e-12));
    }
  }
}

TEST_CASE("services, providers and cells are known apart") {
  quality_map map;
  map.add(map_service, 1, {0, 0}, {1, 1, 0});
  CHECK(map.late(map_service, 1, {0, 0}) > 0.3);
  CHECK(map.late("climate", 1, {0, 0}) < 0.05);
  CHECK(map.late(map_service, 2, {0, 0}) < 0.05);
  CHECK(map.late(map_service, 1, {1, 0}) < 0.05);
}

TEST_CASE("two maps make one of what both know") {
  quality_map one, other;
  one.add(map_service, 1, {0, 0}, {2, 1, 0.02});
  other.add(map_service, 1, {0, 0}, {2, 0, 0.04});
  other.add(map_service, 1, {7, -3}, {1, 1, 0});
  one.add(other);
  CHECK(one.at(map_service, 1, {0, 0}).visits == 4);
  CHECK(one.at(map_service, 1, {0, 0}).late == 1);
  CHECK(one.at(map_service, 1, {0, 0}).latency_s == doctest::Approx(0.03));
  CHECK(one.at(map_service, 1, {7, -3}).late == 1);
  CHECK(one.entries().size() == 2);
  CHECK(one.entries()[1].at == point{75, -25});
}

TEST_CASE_FIXTURE(learning_vehicle,
                  "one fall back makes a place bad, and others stay good") {
  drive(0, 35, 25);
  CHECK(late(5) < 0.05);
  CHECK(late(15) < 0.05);
  CHECK(late(25) > 0.2);
}

TEST_CASE_FIXTURE(learning_vehicle,
                  "a visit counts once, however many results it has") {
  drive(20, 25, 20); // all of them late
  CHECK(map->at(map_service, 1, {2, 0}).visits == 1);
  CHECK(map->at(map_service, 1, {2, 0}).late == 1);
  drive(30, 40);
  drive(40, 41);
  CHECK(map->at(map_service, 1, {3, 0}).visits == 1);
  CHECK(map->at(map_service, 1, {3, 0}).latency_s == doctest::Approx(0.02));
}

TEST_CASE_FIXTURE(learning_vehicle, "a place becomes good again by results "
                                    "that are in time there") {
  drive(0, 10, 5);
  const auto bad = late(0);
  for (int round = 0; round < 4; ++round) {
    drive(10, 20);
    drive(0, 10);
  }
  drive(10, 11);
  CHECK(bad > 0.2);
  CHECK(late(0) < 0.2);
}

TEST_CASE_FIXTURE(learning_vehicle,
                  "offers tell of a place, too, but a fifth as much") {
  forecast.learn(offer(5));
  forecast.learn(offer(15, true));
  forecast.learn(offer(25));
  CHECK(map->at(map_service, 1, {0, 0}) == cell_quality{0.2, 0, 0.02});
  CHECK(map->at(map_service, 1, {1, 0}).late == doctest::Approx(0.2));
  forecast.learn(offer(15, true));
  forecast.learn(result(15, true)); // a result makes up for the rest
  CHECK(map->at(map_service, 1, {1, 0}).late == doctest::Approx(1.2));
}

TEST_CASE_FIXTURE(learning_vehicle,
                  "a result that never comes is late, and has no latency") {
  const auto never = std::numeric_limits<double>::infinity();
  forecast.learn({1, map_service, {5, 0}, never, true, false});
  CHECK(map->at(map_service, 1, {0, 0}) == cell_quality{1, 1, 0});
}

TEST_CASE_FIXTURE(learning_vehicle,
                  "a provider that has started again is the same") {
  auto seen = result(5, true);
  seen.provider = provider_at(1, 4711);
  forecast.learn(seen);
  CHECK(late(5) > 0.3);
}

TEST_CASE_FIXTURE(learning_vehicle, "who goes by a file learns nothing") {
  learned_forecast reader{map, false};
  reader.learn(result(5, true));
  CHECK(map->entries().empty());
}

TEST_CASE_FIXTURE(learning_vehicle,
                  "vehicles that share a map know what the others saw") {
  learned_forecast other{map};
  other.learn(result(5, true));
  CHECK(late(5) > 0.3);
}

TEST_CASE_FIXTURE(learning_vehicle, "a forecast follows the path, at the "
                                    "vehicle's speed, for ten seconds") {
  drive(60, 61, 60);
  std::vector<point> path;
  for (int k = 0; k <= 100; ++k)
    path.push_back({5.0 * k, 0});
  const auto at_10 = forecast_along(forecast, 1, map_service, path, 10);
  REQUIRE(at_10.size() == 21);
  CHECK(at_10.front().in_s == 0);
  CHECK(at_10.back().in_s == doctest::Approx(10));
  CHECK(late_within(at_10, 5.9) < 0.05);
  CHECK(late_within(at_10, 6) > 0.3);
  // Who stands may start.
  const auto standing = forecast_along(forecast, 1, map_service, path, 0);
  CHECK(standing.size() == 7);
  CHECK(forecast_along(forecast, 1, map_service, {}, 10).empty());
  CHECK(late_within({}, 10) == 0);
}
