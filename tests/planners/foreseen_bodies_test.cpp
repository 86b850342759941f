// Which of the bodies near a vehicle matter for judging its plans.
#include "planners/scene/foreseen_bodies.hpp"

#include "tests/support/toy_streets.hpp"

#include <doctest/doctest.h>

#include <numbers>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::planners;
using namespace sofof::world;

namespace {

/// A street that comes from the west, turns left and leads north.
struct left_turn {
  route_ptr way = [] {
    const auto in = toy::straight("in", {-60, 0}, {-6, 0});
    const auto out = toy::straight("out", {0, 6}, {0, 60});
    auto first = in;
    first.next = {"turn"};
    const road_map map{
        "corner", {}, {first, toy::bend("turn", in, out, 0), out}};
    return map.make_route("corner",
                          std::vector<std::string>{"in", "turn", "out"}, false);
  }();
  /// Its rear axle is two metres into the second street, and it points north.
  double s_m = way->path().project({0, 8}, 62, 20).s_m;

  foreseen_bodies seen(const perceived_object& x) const {
    foreseen_bodies all;
    all.look(*way, s_m, std::vector{x}, vehicle_params{});
    return all;
  }
};

perceived_object car_at(point where) {
  return {where, std::numbers::pi / 2, 0, 0, 4.5, 1.8};
}

} // namespace

TEST_CASE_FIXTURE(left_turn,
                  "a car that stands on the way is a reason to brake "
                  "ahead, and none behind") {
  CHECK(seen(car_at({0, 25})).any_ahead(20));
  CHECK_FALSE(seen(car_at({0, 35})).any_ahead(20));
  CHECK_FALSE(seen(car_at({0, 0})).any_ahead(20));
  CHECK_FALSE(seen(car_at({-30, 0})).any_ahead(20));
}

TEST_CASE_FIXTURE(left_turn,
                  "a car that stands beside the vehicle or behind it "
                  "on the crossing may be waited for") {
  CHECK(seen(car_at({8, 14})).any_near(30, 40));
  CHECK(seen(car_at({30, 14})).any_near(30, 40));
}

TEST_CASE_FIXTURE(left_turn,
                  "a car a few metres behind, as the vehicle points, "
                  "counts where the way leads past it") {
  s_m = way->path().project({-6, 0}, 54, 20).s_m;
  CHECK(seen(car_at({-12, 20})).any_near(30, 40));
}

TEST_CASE_FIXTURE(left_turn, "a car more than twenty metres behind, as the "
                             "vehicle points, is left out, wherever the way "
                             "leads") {
  CHECK_FALSE(seen(car_at({46, -20})).any_near(30, 40));
  CHECK_FALSE(seen(car_at({-20, -20})).any_near(30, 40));
}

TEST_CASE_FIXTURE(left_turn,
                  "a body is in reach as soon as its nearer side is") {
  auto lorry = car_at({7, 14});
  lorry.width_m = 8; // from 3 to 11 m beside the way
  CHECK(seen(lorry).any_in_reach(20, 2.5, 0));
  CHECK_FALSE(seen(lorry).any_in_reach(20, 1.5, 0));
  lorry.width_m = 1.8;
  CHECK_FALSE(seen(lorry).any_in_reach(20, 2.5, 0));
}

TEST_CASE_FIXTURE(left_turn,
                  "a vehicle that steers out past a body has its front beside "
                  "it, not where its rear axle is") {
  const auto body = seen(car_at({0, 25})); // its middle, 15 m ahead
  constexpr vehicle_params own;
  const auto passes_m = 1.8 / 2 + own.width_m / 2; // from middle to middle
  const auto at = [&](double d_m, double turned) {
    const place_in_time p{1, s_m + 17 - 4.5 / 2 - own.front_m + 0.5, d_m,
                          turned, 5};
    return body.first_touch(std::vector{p}, own).has_value();
  };
  CHECK(at(passes_m - 0.5, 0));
  CHECK_FALSE(at(passes_m - 0.5, 0.2)); // its front is 0.6 m farther left
  CHECK(at(-passes_m + 0.5, 0));
  CHECK_FALSE(at(-passes_m + 0.5, -0.2));
  CHECK(at(passes_m, -0.2)); // it steers into it
}
