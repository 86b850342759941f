// Where vehicles start.
#include "scenario/placement.hpp"

#include "tests/scenario/example.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace sofof;
using namespace sofof::scenario;
using namespace sofof::world;

namespace {

scenario_definition with_fleet(const fleet_options& fleet) {
  auto s = example::load();
  s.fleets = {fleet};
  return s;
}

/// @returns where the vehicles start, in order of their stations, m.
std::vector<double> starts_of(const fleet_options& fleet) {
  std::vector<double> starts;
  for (const auto& v : place_vehicles(with_fleet(fleet)))
    starts.push_back(v.start_s_m);
  return starts;
}

} // namespace

TEST_CASE("every vehicle has its station and its route in turn") {
  const auto placed = place_vehicles(example::load());
  REQUIRE(placed.size() == 8);
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(placed[i].station == 101 + i);
    CHECK(placed[i].fleet == 0);
    CHECK(placed[i].way->name()
          == (i % 2 == 0 ? "round_trip" : "round_trip_opposite"));
  }
  CHECK(placed[7].station == 202);
  CHECK(placed[7].fleet == 1);
}

TEST_CASE("vehicles appear one after another") {
  const auto placed =
      place_vehicles(with_fleet({.count = 3,
                                 .appears_at = std::chrono::seconds{5},
                                 .appear_every = std::chrono::seconds{20}}));
  CHECK(placed[0].appears == std::chrono::seconds{5});
  CHECK(placed[2].appears == std::chrono::seconds{45});
}

TEST_CASE("who appears later may start where others do") {
  const fleet_options there{.count = 2, .placement = "convoy", .spacing_m = 0};
  CHECK(find_too_near(place_vehicles(with_fleet(there))));
  auto later = there;
  later.appear_every = std::chrono::seconds{1};
  CHECK_FALSE(find_too_near(place_vehicles(with_fleet(later))));
}

TEST_CASE("equal vehicles share a closed route evenly") {
  const auto length_m = example::load().world->find("round_trip")->length_m();
  const auto starts = starts_of(
      {.count = 4, .routes = {"round_trip"}, .start_m = 0.8 * length_m});
  for (std::size_t i = 0; i < 4; ++i)
    CHECK(starts[i]
          == doctest::Approx(std::fmod(0.8 + 0.25 * static_cast<double>(i), 1)
                             * length_m));
}

TEST_CASE("equal vehicles that take turns on two routes share each evenly") {
  const auto s = example::load();
  const auto placed = place_vehicles(s);
  for (const auto i : {0u, 1u})
    for (const auto k : {1u, 2u})
      CHECK(placed[i + 2 * k].start_s_m
            == doctest::Approx(k * placed[i].way->length_m() / 3));
  const auto odd =
      starts_of({.count = 3, .routes = {"round_trip", "round_trip_opposite"}});
  CHECK(odd[2] == doctest::Approx(placed[0].way->length_m() / 2));
}

TEST_CASE("equal vehicles share the rest of an open route") {
  CHECK(starts_of({.count = 4, .routes = {"straight"}, .start_m = 40})
        == std::vector<double>{40, 80, 120, 160});
}

TEST_CASE("a vehicle alone on an open route starts where it is told") {
  for (const auto* placement : {"equal", "convoy"})
    CHECK(
        starts_of(
            {.routes = {"straight"}, .placement = placement, .start_m = 40.25})
        == std::vector<double>{40.25});
}

TEST_CASE("a convoy queues up behind its leader") {
  CHECK(starts_of({.count = 3,
                   .routes = {"straight"},
                   .placement = "convoy",
                   .spacing_m = 20,
                   .start_m = 100})
        == std::vector<double>{100, 80, 60});
}

TEST_CASE("a convoy on a closed route reaches back over its start") {
  const auto length_m = example::load().world->find("round_trip")->length_m();
  const auto starts = starts_of({.count = 2,
                                 .routes = {"round_trip"},
                                 .placement = "convoy",
                                 .spacing_m = 30,
                                 .start_m = 10});
  CHECK(starts[0] == doctest::Approx(10));
  CHECK(starts[1] == doctest::Approx(length_m - 20));
}

TEST_CASE("routes can be named all at once") {
  const auto placed =
      place_vehicles(with_fleet({.count = 3, .routes = {"round*"}}));
  CHECK(placed[0].way->name() == "round_trip");
  CHECK(placed[1].way->name() == "round_trip_opposite");
  CHECK(placed[2].way->name() == "round_trip");
}

TEST_CASE("a route that is named twice is still one route") {
  const auto length_m = example::load().world->find("round_trip")->length_m();
  const auto starts =
      starts_of({.count = 2, .routes = {"round_trip", "round*"}});
  CHECK(starts[1] == doctest::Approx(length_m / 2));
}

TEST_CASE("a convoy that is longer than its open route stands off it") {
  const auto s = with_fleet({.count = 3,
                             .routes = {"straight"},
                             .placement = "convoy",
                             .spacing_m = 60,
                             .start_m = 100});
  const auto placed = place_vehicles(s);
  CHECK_FALSE(placed[1].off_its_way());
  CHECK(placed[2].off_its_way());
}

TEST_CASE("vehicles need their length and three metres") {
  const vehicle_params car;
  const auto room_m = car.front_m + car.rear_m + min_start_gap_m;
  auto fleet = fleet_options{.count = 2,
                             .routes = {"straight"},
                             .placement = "convoy",
                             .spacing_m = room_m + 0.01,
                             .start_m = 100};
  CHECK_FALSE(find_too_near(place_vehicles(with_fleet(fleet))));
  fleet.spacing_m = room_m - 0.01;
  const auto near = find_too_near(place_vehicles(with_fleet(fleet)));
  REQUIRE(near);
  CHECK(*near == std::pair<std::size_t, std::size_t>{0, 1});
}

TEST_CASE("vehicles of different fleets must not stand on each other") {
  auto s = example::load();
  s.fleets = {{.count = 1, .routes = {"round_trip"}},
              {.count = 1, .first_station = 201, .routes = {"round_trip"}}};
  CHECK(find_too_near(place_vehicles(s)));
  s.fleets[1].start_m = 100;
  CHECK_FALSE(find_too_near(place_vehicles(s)));
}

TEST_CASE("vehicles side by side are not in each other's way") {
  auto s = example::load();
  s.fleets = {
      {.count = 1, .routes = {"round_trip"}},
      {.count = 1,
       .first_station = 201,
       .routes = {"round_trip_opposite"},
       .start_m = s.world->find("round_trip_opposite")->length_m() / 2}};
  CHECK_FALSE(find_too_near(place_vehicles(s)));
}
