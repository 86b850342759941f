// How long a vehicle stays with a provider that moves.
#include "policies/filters/location.hpp"
#include "policies/registry.hpp"
#include "tests/support/decisions.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <limits>
#include <optional>
#include <vector>

using namespace sofof;
using namespace sofof::policies;

namespace sofof::test::moving_areas {

using namespace std::chrono_literals;

using street = std::vector<point>;

const polygon ten_m_square{{{-10, -10}, {10, -10}, {10, 10}, {-10, 10}}};

/// From `from_m` on the east axis, a waypoint every metre.
street east_from(double from_m, double length_m) {
  street route;
  for (double x_m = 0; x_m <= length_m; ++x_m)
    route.push_back({from_m + x_m, 0});
  return route;
}

/// Whether the LODM asks a provider 60 m behind, with r_off = 300 m, that
/// serves who is nearer than `reach_m`.
bool asks(point velocity_mps, double speed_mps, double reach_m = 100) {
  const std::vector<provider_view> one{{.id = 7,
                                        .at = {-60, 0},
                                        .velocity_mps = velocity_mps,
                                        .reach_m = reach_m}};
  const auto path = east_from(0, 800);
  const auto lodm = make_lodm("location");
  return goes_to(lodm->decide({time_point{}, "any", one, path, speed_mps}))
      .has_value();
}

} // namespace sofof::test::moving_areas

using namespace sofof::test::moving_areas;
using doctest::Approx;

TEST_CASE("an area that drives along holds a vehicle for all of its route") {
  CHECK(*time_in_area_s(east_from(0, 100), ten_m_square, {5, 0}, 5)
        == Approx(20));
}

TEST_CASE("an area that comes towards a vehicle is left at the sum of both "
          "speeds") {
  CHECK(*time_in_area_s(east_from(0, 100), ten_m_square, {-5, 0}, 5)
        == Approx(1));
}

TEST_CASE("a vehicle that overtakes an area leaves it at the difference of "
          "both speeds, and one that is overtaken by it") {
  for (const auto drives_mps : {4.0, 6.0})
    CHECK(*time_in_area_s(east_from(0, 100), ten_m_square, {drives_mps, 0}, 5)
          == Approx(10).epsilon(0.03)); // a waypoint
}

TEST_CASE("an area that turns off is left to the side") {
  CHECK(*time_in_area_s(east_from(0, 100), ten_m_square, {5, 5}, 5)
        == Approx(2));
}

TEST_CASE("an area that moves leaves who stands, to within a metre") {
  const auto left_s = time_in_area_s(east_from(0, 10), ten_m_square, {2, 0}, 0);
  CHECK(*left_s >= 4.5);
  CHECK(*left_s <= 5);
  CHECK(*time_in_area_s(east_from(0, 10), ten_m_square, {2, 0}, 0, 1) > 1);
  CHECK(*time_in_area_s(east_from(0, 10), ten_m_square, {0.05, 0}, 0)
        == std::numeric_limits<double>::infinity());
}

TEST_CASE("who is outside an area that moves has no time in it") {
  CHECK(!time_in_area_s(east_from(11, 10), ten_m_square, {5, 0}, 5));
  CHECK(!time_in_area_s({}, ten_m_square, {5, 0}, 5));
}

TEST_CASE("an area that stands is as it always was") {
  test::dice random{28};
  for (int k = 0; k < 1000; ++k) {
    const auto route = east_from(random.between(-12, 12), 40);
    const auto speed_mps = random.between(0, 20);
    CHECK(time_in_area_s(route, ten_m_square, point{}, speed_mps)
          == time_in_area_s(route, ten_m_square, speed_mps));
    CHECK(distance_in_disc_m(route, {}, point{}, speed_mps, 10, 30)
          == distance_in_disc_m(route, {}, 10, 30));
  }
}

TEST_CASE("time in an area is the same in a frame that moves with it") {
  test::dice random{29};
  for (int k = 0; k < 1000; ++k) {
    const auto speed_mps = random.between(1, 20);
    const point velocity_mps{random.between(-20, 20), random.between(-20, 20)};
    const auto route = east_from(random.between(-9, 9), 200);
    street relative; // as who sits in the area sees it
    for (const auto at : route)
      relative.push_back(
          at - (distance_m(route[0], at) / speed_mps) * velocity_mps);
    std::size_t inside = 0;
    while (inside < relative.size() && ten_m_square.contains(relative[inside]))
      ++inside;
    REQUIRE(inside > 0);
    CHECK(*time_in_area_s(route, ten_m_square, velocity_mps, speed_mps)
          == Approx(static_cast<double>(inside - 1) / speed_mps));
  }
}

TEST_CASE("a provider that drives along is asked, and one that comes from "
          "behind and goes back is not") {
  CHECK(asks({10, 0}, 10));
  CHECK_FALSE(asks({-10, 0}, 10)); // 40 m are left, at twice the speed
  CHECK_FALSE(asks({}, 10));       // d_passed = 39 m < d_min = 50 m
}

TEST_CASE("a provider that moves is asked within its own reach, and one that "
          "stands within r_off") {
  CHECK_FALSE(asks({10, 0}, 10, 59));
  CHECK(asks({10, 0}, 10, 61));
  const std::vector<provider_view> one{{.id = 7, .at = {-60, 0}}};
  const auto path = east_from(0, 800);
  CHECK(test::goes_to(
      make_lodm("location")->decide({time_point{}, "any", one, path, 10})));
}

TEST_CASE("a provider that drives off is not asked by who stands") {
  CHECK_FALSE(asks({10, 0}, 0));
}

TEST_CASE("the CODM weighs where the area will be") {
  const world::road_map map{
      "street",
      {},
      {{"street", east_from(-500, 1000), 1.75, {{0, 14}}, {}, 0}}};
  const auto codm = make_codm("location");
  const auto route = east_from(0, 400);
  const std::vector<request_view> one{
      {.station = 101, .service = "any", .route = route, .speed_mps = 10}};
  const auto accepts = [&](point velocity_mps) {
    const auto decided = codm->decide({.now = {},
                                       .requests = one,
                                       .sessions = {},
                                       .area = ten_m_square,
                                       .map = map,
                                       .area_velocity_mps = velocity_mps});
    return test::is_accepted(decided.front());
  };
  CHECK(accepts({10, 0}));
  CHECK(accepts({9, 0}));       // 10 s
  CHECK_FALSE(accepts({}));     // 1 s
  CHECK_FALSE(accepts({7, 0})); // 3.3 s of t_min = 5 s
}
