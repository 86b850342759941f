// What somebody who looks would have told of, had it been there.
#include "planners/plausibility/witness.hpp"

#include <doctest/doctest.h>

#include <vector>

using namespace sofof;
using namespace sofof::planners;
using namespace sofof::world;
using namespace std::chrono_literals;

namespace {

constexpr time_point looked_at{100s};

perceived_object standing_at(double x_m, double speed_mps = 0) {
  return {{x_m, 0}, 0, speed_mps, 0, 5.1, 1.89};
}

track known_as(const perceived_object& x) {
  track t;
  t.at = t.seen = looked_at;
  t.motion.mean << x.centre.x_m, x.speed_mps, x.centre.y_m, 0;
  t.length_m = x.length_m;
  t.width_m = x.width_m;
  return t;
}

/// A look from the origin, 100 m far.
witness looking(const std::vector<perceived_object>& seen,
                const std::vector<std::uint32_t>& ids, std::size_t in_sight,
                double field_deg = 360) {
  witness w;
  w.look({looked_at,
          {{0, 0}, 0, 100, field_deg},
          0,
          looked_at,
          seen,
          ids,
          in_sight});
  return w;
}

const line_of_sight no_buildings;
constexpr std::span<const std::uint32_t> no_ids;

} // namespace

TEST_CASE("who tells of all that it perceives overlooks what lies open") {
  CHECK(looking({}, {}, 0).overlooks(known_as(standing_at(40)), no_buildings));
  CHECK(looking({standing_at(-30)}, {7}, 1)
            .overlooks(known_as(standing_at(40)), no_buildings));
}

TEST_CASE("who perceives more than it has told of overlooks nothing") {
  CHECK_FALSE(looking({standing_at(-30)}, {7}, 2)
                  .overlooks(known_as(standing_at(40)), no_buildings));
}

TEST_CASE("an object that is not told of again is known for 1.25 s") {
  const auto w = looking({standing_at(-30)}, {7}, 1);
  const auto is_complete_at = [&](time_point t) {
    auto later = w;
    later.look({t, {{0, 0}, 0, 100}, 0, t, {}, no_ids, 1});
    return later.overlooks(known_as(standing_at(40)), no_buildings);
  };
  CHECK(is_complete_at(looked_at + 1250ms));
  CHECK_FALSE(is_complete_at(looked_at + 1251ms));
}

TEST_CASE("what is just within range or field of view is not overlooked") {
  CHECK(looking({}, {}, 0).overlooks(known_as(standing_at(95)), no_buildings));
  CHECK_FALSE(
      looking({}, {}, 0).overlooks(known_as(standing_at(97)), no_buildings));
  auto beside = standing_at(40);
  beside.centre.y_m = 20; // 27 degrees off
  CHECK(looking({}, {}, 0, 90).overlooks(known_as(beside), no_buildings));
  CHECK_FALSE(looking({}, {}, 0, 60).overlooks(known_as(beside), no_buildings));
  CHECK_FALSE(looking({}, {}, 0, 40).overlooks(known_as(beside), no_buildings));
}

TEST_CASE("what another vehicle may hide is not overlooked") {
  CHECK_FALSE(looking({standing_at(20)}, {7}, 1)
                  .overlooks(known_as(standing_at(40)), no_buildings));
  auto hidden = standing_at(20);
  hidden.centre.y_m = 10;
  CHECK(looking({hidden}, {7}, 1)
            .overlooks(known_as(standing_at(40)), no_buildings));
}

TEST_CASE("what has just come into view is not overlooked yet") {
  auto fast = known_as(standing_at(93, -30)); // 0.3 s ago at 102 m
  CHECK_FALSE(looking({}, {}, 0).overlooks(fast, no_buildings));
  CHECK(looking({}, {}, 0).would_see(fast, no_buildings, looked_at));
}

TEST_CASE("a body that moves otherwise is another one in the same place") {
  using enum witness::sight;
  const auto w = looking({standing_at(40, 10)}, {7}, 1);
  CHECK(w.look_at(known_as(standing_at(41, 9))) == same);
  CHECK(w.look_at(known_as(standing_at(41, 0))) == another);
  CHECK(w.look_at(known_as(standing_at(45, 10))) == nothing);
  auto beside = standing_at(40, 10);
  beside.centre.y_m = 1.9;
  CHECK(w.look_at(known_as(beside)) == nothing);
}

TEST_CASE("a long body lies open where its end does") {
  const auto house = [](point low, point high) {
    return building{{low, {high.x_m, low.y_m}, high, {low.x_m, high.y_m}}};
  };
  const std::vector<building> houses{house({20, -3}, {22, 3})};
  const line_of_sight lines{houses};
  perceived_object lorry{{40, 0}, 1.5708, 0, 0, 24, 2.5};
  auto across = known_as(lorry);
  across.heading_rad = 1.5708;
  CHECK(looking({}, {}, 0).overlooks(across, lines));
  across.length_m = 4.5;
  CHECK_FALSE(looking({}, {}, 0).overlooks(across, lines));
}
