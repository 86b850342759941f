// Who crosses, when, and who goes first, as one vehicle judges it.
#include "planners/scene/crossing_predictor.hpp"

#include "tests/planners/onlooker.hpp"
#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

using namespace sofof;
using namespace sofof::planners;
using namespace sofof::test;
using namespace sofof::world;
using std::numbers::pi;
using namespace std::chrono_literals;

// Four arms around a junction; 3 west, 1 east: a road with the right of way;
// 4 south, 2 north.

namespace {

/// Who comes from there and judges the crossing.
onlooker at_cross_roads(std::vector<std::size_t> junctions, double s_m,
                        bool equal = false, bool judges = true) {
  const auto map = toy::cross_roads(equal);
  scene_params params;
  params.judges_crossings = judges;
  onlooker o{map, toy::make_route(map, junctions), params};
  o.me.s_m = s_m;
  return o;
}

/// @returns whoever is on the stretch that holds a place of the own way.
const crossing_user* find_crossing(const onlooker& o, point place) {
  const auto at_m = o.way->path().project(place).s_m;
  for (const auto& c : o.seen.crossings)
    if (c.from_m < at_m && at_m < c.to_m)
      return &c;
  return nullptr;
}

constexpr point from_south_meets_from_west{1.75, -1.75};

} // namespace

TEST_CASE("who comes across is foreseen, and when") {
  auto o = at_cross_roads({4, 0, 2}, 100);
  o.look({seen_track({-50, -1.75}, 0, 10)});
  const auto* c = find_crossing(o, from_south_meets_from_west);
  REQUIRE(c);
  // Bodies touch from 2.4 m on, and there is a metre of margin.
  CHECK(c->enter_s == doctest::Approx(4.58).epsilon(0.01));
  CHECK(c->leave_s == doctest::Approx(5.77).epsilon(0.01));
  CHECK(c->from_m == doctest::Approx(138 - 1.75 - 3.4).epsilon(0.005));
  CHECK(c->to_m == doctest::Approx(138 - 1.75 + 3.4).epsilon(0.005));
  CHECK(c->goes_first);
  CHECK_FALSE(o.seen.lead);
  for (std::size_t i = 1; i < o.seen.crossings.size(); ++i)
    CHECK(o.seen.crossings[i - 1].from_m <= o.seen.crossings[i].from_m);
}

TEST_CASE("crossings that others grant are not judged") {
  auto o = at_cross_roads({4, 0, 2}, 100, false, false);
  o.look({seen_track({-50, -1.75}, 0, 10)});
  CHECK(o.seen.crossings.empty());
}

TEST_CASE("who has to give way does so, unless it cannot stop any more") {
  auto o = at_cross_roads({3, 0, 1}, 100);
  o.look({seen_track({1.75, -60}, pi / 2, 10)});
  const auto* c = find_crossing(o, from_south_meets_from_west);
  REQUIRE(c);
  CHECK_FALSE(c->goes_first);
  o.look({seen_track({1.75, -15}, pi / 2, 10)}); // 7 m: 7 m/s^2
  c = find_crossing(o, from_south_meets_from_west);
  REQUIRE(c);
  CHECK(c->goes_first);
}

TEST_CASE("who comes towards one, would have to give way to turn, and does "
          "not slow down, goes straight on") {
  auto o = at_cross_roads({3, 0, 1}, 100);
  o.me.s_m = o.way->path().project({0, -1.75}).s_m - 14;
  o.me.speed_mps = 7;
  auto oncoming = seen_track({12.5, 1.75}, pi, 5.4); // it may turn across
  REQUIRE_FALSE(o.look({oncoming}).crossings.empty());
  for (const auto& c : o.seen.crossings)
    CHECK_FALSE(c.goes_first);
  // From the south each way meets the own one.
  const auto comes = seen_track({1.75, -8}, pi / 2, 5.4);
  o.look({comes});
  const auto* c = find_crossing(o, from_south_meets_from_west);
  REQUIRE(c);
  CHECK(c->goes_first);
}

TEST_CASE(
    "for a car that could only brake hard any more who would have to give "
    "way, and may turn off, does not come, even if it brakes a little") {
  auto o = at_cross_roads({3, 0, 1}, 100);
  const auto middle_m = o.way->path().project({0, -1.75}).s_m;
  o.me.speed_mps = 8;
  auto oncoming = seen_track({12.5, 1.75}, pi, 7);
  oncoming.accel_mps2 = -1.5;
  const auto one_goes_first = [&](double before_m) {
    o.me.s_m = middle_m - before_m;
    o.look({oncoming});
    REQUIRE_FALSE(o.seen.crossings.empty());
    return std::ranges::any_of(o.seen.crossings, &crossing_user::goes_first);
  };
  CHECK_FALSE(one_goes_first(9));
  CHECK(one_goes_first(24)); // it can stop, and does not know
}

TEST_CASE("who rolls on where it would have to brake by now goes first") {
  auto o = at_cross_roads({3, 0, 1}, 100);
  auto x = seen_track({1.75, -6.1}, pi / 2, 2); // 0.6 m to go
  o.look({x});
  const auto* c = find_crossing(o, from_south_meets_from_west);
  REQUIRE(c);
  CHECK(c->goes_first);
  x.accel_mps2 = -2;
  o.look({x});
  c = find_crossing(o, from_south_meets_from_west);
  REQUIRE(c);
  CHECK_FALSE(c->goes_first);
}

TEST_CASE("of equals who comes from the right goes first") {
  auto o = at_cross_roads({3, 0, 1}, 100, true);
  o.look({seen_track({1.75, -60}, pi / 2, 10)});
  const auto* c = find_crossing(o, from_south_meets_from_west);
  REQUIRE(c);
  CHECK(c->goes_first);
  o.look({seen_track({-1.75, 60}, -pi / 2, 10)}); // from the left
  c = find_crossing(o, {-1.75, -1.75});
  REQUIRE(c);
  CHECK_FALSE(c->goes_first);
}

TEST_CASE("of equals that come towards each other who turns left gives way") {
  const auto oncoming = seen_track({60, 1.75}, pi, 10);
  auto left = at_cross_roads({3, 0, 2}, 100, true);
  REQUIRE_FALSE(left.look({oncoming}).crossings.empty());
  CHECK(std::ranges::any_of(left.seen.crossings, &crossing_user::goes_first));
  auto straight = at_cross_roads({3, 0, 1}, 100, true);
  REQUIRE_FALSE(straight.look({oncoming}).crossings.empty()); // it may turn
  for (const auto& user : straight.seen.crossings)
    CHECK_FALSE(user.goes_first);
}

TEST_CASE("who stands before a crossing is waited for until it has stood there "
          "for some seconds") {
  auto o = at_cross_roads({3, 0, 1}, 130, true);
  auto x = seen_track({1.75, -9.5}, pi / 2); // its front at 6.95 m
  const auto other_first = [&](duration stood) {
    x.moved = look_time - stood;
    o.look({x});
    const auto* c = find_crossing(o, from_south_meets_from_west);
    REQUIRE(c);
    CHECK(c->enter_s > 0.5);
    CHECK(std::isfinite(c->leave_s));
    return c->goes_first;
  };
  CHECK(other_first(1s));
  CHECK(other_first(4s));
  CHECK_FALSE(other_first(4s + 1ms));
  for (std::uint32_t station = 101; station < 120; ++station) {
    o.me.station = station;
    CHECK(other_first(4s));
    CHECK_FALSE(other_first(8s));
  }
}

TEST_CASE("who has the better rank is waited for longer, though it stands") {
  auto o = at_cross_roads({4, 0, 2}, 125); // gives way to the road
  auto x = seen_track({-9.5, -1.75}, 0);
  const auto other_first = [&](duration stood) {
    x.moved = look_time - stood;
    o.look({x});
    const auto* c = find_crossing(o, from_south_meets_from_west);
    REQUIRE(c);
    return c->goes_first;
  };
  CHECK(other_first(4s + 1ms));
  CHECK(other_first(11s));
  CHECK_FALSE(other_first(16s));
}

TEST_CASE("who is slow may be setting off, and is there sooner than at its "
          "speed") {
  auto o = at_cross_roads({4, 0, 2}, 125);
  const auto enters_s = [&](double speed_mps) {
    o.look({seen_track({-11, -1.75}, 0, speed_mps)});
    const auto* c = find_crossing(o, from_south_meets_from_west);
    REQUIRE(c);
    CHECK(c->leave_s > 12 / speed_mps); // as it drives
    return c->enter_s;
  };
  CHECK(enters_s(0.5) < 4);
  CHECK(enters_s(3.1) < enters_s(0.5));
}

TEST_CASE("who has to wait for a third one is foreseen to leave later") {
  auto o = at_cross_roads({4, 0, 3}, 110); // turns left, and gives way to all
  const auto oncoming = seen_track({1.75 + 25, 1.75}, pi, 8);
  auto turning = seen_track({-14.5, -1.75}, 0, 4); // perhaps to the left
  const auto leaves_s = [&](const std::vector<track>& all) {
    auto last_s = 0.0;
    o.look(all);
    for (const auto& c : o.seen.crossings)
      if (c.body == turning.id && c.goes_first)
        last_s = std::max(last_s, c.leave_s);
    return last_s;
  };
  turning.id = 7;
  const auto alone_s = leaves_s({turning});
  REQUIRE(alone_s > 0);
  CHECK(leaves_s({turning, oncoming}) > alone_s + 1);
}

TEST_CASE("who has stood for long itself waits for nobody who stands") {
  auto o = at_cross_roads({3, 0, 1}, 130, true);
  const auto waits_for_it = [&](duration stood) {
    auto x = seen_track({1.75, -9.5}, pi / 2);
    x.at = x.seen = look_time + stood;
    x.moved = x.at - 1s;
    o.look({x}, look_time + stood);
    const auto* c = find_crossing(o, from_south_meets_from_west);
    REQUIRE(c);
    return c->goes_first;
  };
  CHECK(waits_for_it(0s));
  CHECK(waits_for_it(14s));
  CHECK_FALSE(o.seen.is_impatient);
  CHECK_FALSE(waits_for_it(19s));
  CHECK(o.seen.is_impatient);
  o.me.speed_mps = 1;
  CHECK(waits_for_it(0s));
}

TEST_CASE("who has to give way is patient for longer") {
  const auto impatient_from = [](const std::vector<std::size_t>& way) {
    auto o = at_cross_roads(way, 130);
    auto stood = 10s;
    for (; !o.seen.is_impatient && stood < 60s; stood += 1s) {
      o.look({}, look_time);
      o.look({}, look_time + stood);
    }
    return stood;
  };
  CHECK(impatient_from({4, 0, 2}) > impatient_from({3, 0, 1}) + 10s);
}

TEST_CASE("a car does not come to rest where others cross") {
  auto o = at_cross_roads({3, 0, 1}, 100);
  o.look({});
  REQUIRE(o.seen.keep_free.size() == 1); // no car fits between its zones
  CHECK(o.seen.keep_free[0].from_m
        < o.way->path().project(from_south_meets_from_west).s_m - 3);
  CHECK(o.seen.keep_free[0].to_m
        > o.way->path().project(from_south_meets_from_west).s_m + 3);
}

TEST_CASE("a car whose front is among crossings does not come to rest on the "
          "next ones") {
  auto o = at_cross_roads({3, 0, 1}, 100);
  o.look({});
  REQUIRE(o.seen.keep_free.size() == 1);
  const auto all = o.seen.keep_free[0];
  const auto front_m = all.from_m + 0.1;
  o.me.s_m = front_m - scene_params{}.car.front_m;
  o.look({});
  REQUIRE(o.seen.keep_free.size() == 2);
  CHECK(o.seen.keep_free[0].from_m == doctest::Approx(all.from_m));
  CHECK(o.seen.keep_free[1].from_m > front_m);
  CHECK(o.seen.keep_free[1].to_m == doctest::Approx(all.to_m));
}

TEST_CASE("who stands does not set off before who has just set off") {
  auto o = at_cross_roads({3, 0, 1}, 129, true);
  o.me.speed_mps = 0;
  auto x = seen_track({-1.75, 11}, -pi / 2, 0.6); // from the left
  const auto other_first = [&] {
    o.look({x});
    REQUIRE_FALSE(o.seen.crossings.empty());
    return std::ranges::any_of(o.seen.crossings, &crossing_user::goes_first);
  };
  CHECK_FALSE(other_first());
  x.accel_mps2 = 1;
  CHECK(other_first());
  o.me.speed_mps = 2; // it has set off, too
  CHECK_FALSE(other_first());
}

TEST_CASE("a car waits before all crossings for who is slow and goes first") {
  auto o = at_cross_roads({4, 0, 2}, 120);
  o.me.speed_mps = 3;
  const auto first_line_m = [&](double speed_mps) {
    o.look({seen_track({-12, -1.75}, 0, speed_mps)});
    auto from_m = std::numeric_limits<double>::infinity();
    for (const auto& c : o.seen.crossings)
      if (c.goes_first)
        from_m = std::min(from_m, c.from_m);
    return from_m;
  };
  REQUIRE(std::isfinite(first_line_m(2)));
  CHECK(first_line_m(2) == o.seen.keep_free[0].from_m);
}

TEST_CASE("who comes towards one may turn across, but gives way then") {
  auto o = at_cross_roads({3, 0, 1}, 100);
  o.look({seen_track({60, 1.75}, pi, 10)});
  REQUIRE_FALSE(o.seen.crossings.empty());
  for (const auto& c : o.seen.crossings)
    CHECK_FALSE(c.goes_first);
  CHECK_FALSE(o.seen.lead);
}

TEST_CASE("who has crossed, or is too far away, is not crossing") {
  auto o = at_cross_roads({4, 0, 2}, 100);
  CHECK(o.look({seen_track({20, -1.75}, 0, 10)}).crossings.empty());
  CHECK(o.look({seen_track({-140, -1.75}, 0, 10)}).crossings.empty());
  o.me.s_m = 170; // oneself has crossed
  CHECK(o.look({seen_track({-50, -1.75}, 0, 10)}).crossings.empty());
}

TEST_CASE(
    "who drives across is no lead besides, unless crossings are granted") {
  const auto across = seen_track({0, -1.75}, 0, 5);
  auto o = at_cross_roads({4, 0, 2}, 100);
  o.look({across});
  const auto* c = find_crossing(o, from_south_meets_from_west);
  REQUIRE(c);
  CHECK(c->enter_s == 0);
  CHECK(c->goes_first);
  CHECK_FALSE(o.seen.lead);
  o = at_cross_roads({4, 0, 2}, 100, false, false);
  CHECK(o.look({across}).lead);
}

TEST_CASE(
    "who stands on a crossing leads where it is in the way, and is nobody's "
    "business where it is not") {
  auto o = at_cross_roads({3, 0, 1}, 100); // one's own right of way or not
  o.look({seen_track({1.75, -1.75}, pi / 2)});
  CHECK(o.seen.crossings.empty());
  CHECK(o.seen.lead);
  o.look({seen_track({1.75, -6.5}, pi / 2)}); // its nose 2.2 m beside
  for (const auto& c : o.seen.crossings)
    CHECK_FALSE(c.goes_first);
  CHECK_FALSE(o.seen.lead);
}

TEST_CASE("who crosses where the own front is already leads while it is in the "
          "way") {
  auto o = at_cross_roads({3, 0, 1}, 132);
  const auto across = seen_track({1.75, -4}, pi / 2, 5);
  CHECK_FALSE(o.look({across}).lead);
  o.me.s_m = 136;
  CHECK(o.look({across}).lead);
}

TEST_CASE("who goes ahead on the own way leads over a crossing") {
  for (const auto& way :
       {std::vector<std::size_t>{3, 0, 1}, {4, 0, 1}, {4, 0, 2}, {1, 0, 4}}) {
    auto o = at_cross_roads(way, 0);
    for (; o.me.s_m < 240; o.me.s_m += 0.5) {
      o.look({on_way(*o.way, o.me.s_m + 12, 6)});
      CHECK(o.seen.lead);
      CHECK(o.seen.crossings.empty());
    }
  }
}

TEST_CASE("who merges is crossing first, and then the lead") {
  auto o = at_cross_roads({4, 0, 1}, 110);
  const auto map = toy::cross_roads();
  const auto other = toy::make_route(map, {3, 0, 1});
  auto was_crossing = false, was_lead = false;
  for (auto s_m = 100.0; s_m < 170; s_m += 0.5) {
    o.look({on_way(*other, s_m, 8)});
    CHECK((o.seen.lead || !o.seen.crossings.empty()));
    was_crossing = was_crossing || !o.seen.crossings.empty();
    was_lead = was_lead || o.seen.lead;
    if (was_lead)
      CHECK(o.seen.lead);
  }
  CHECK(was_crossing);
  CHECK(o.seen.crossings.empty());
}

TEST_CASE(
    "who waits for its claim is minded once it is in the way, not where a "
    "zone begins") {
  const auto map = toy::cross_roads();
  const auto way = toy::make_route(map, {4, 0, 2});
  constexpr auto corridor_m = 1.2;
  crossing_predictor eyes{look_at(map, way), corridor_m, 8};
  std::vector<way_stretch> keep_free;
  eyes.look_ahead(115, 120, 200, keep_free);
  const auto users = [&](double front_x_m, double speed_mps) {
    other_body x;
    x.x = seen_track({front_x_m - 2.55, -1.75}, 0, speed_mps);
    x.takes_part = true;
    std::vector others{x};
    std::vector<crossing_user> found;
    std::vector<double> yields;
    eyes.judge({{}, 115, 120, 5, false}, others, keep_free, found, yields);
    return found.size();
  };
  // The own way is 1.75 m east of the middle, and the zone begins before -1.5
  // m.
  CHECK(users(-1.2, 0.8) == 0);
  CHECK(users(1, 0.8) > 0);
  CHECK(users(-1.2, 5) > 0); // it cannot stop any more
}

TEST_CASE("Lehr: through traffic is not kept by whoever has to give way") {
  scene_params params;
  params.judges_crossings = true;
  onlooker o{lehr().map, lehr().route("west_to_east"), params};
  o.me.s_m = 200;
  const auto side = lehr().route("north_to_east");
  auto foreseen = false;
  for (auto s_m = 60.0; s_m < 160; s_m += 2) { // the arm is 163 m long
    o.look({on_way(*side, s_m, 8)});
    CHECK_FALSE(o.seen.lead);
    for (const auto& c : o.seen.crossings) {
      CHECK_FALSE(c.goes_first);
      foreseen = true;
    }
  }
  CHECK(foreseen);
}

TEST_CASE("Lehr: who turns left across the road waits for through traffic") {
  scene_params params;
  params.judges_crossings = true;
  onlooker o{lehr().map, lehr().route("west_to_north"), params};
  o.me.s_m = 200;
  const auto through = lehr().route("east_to_west");
  const auto& seen = o.look({on_way(*through, 270, 8)});
  CHECK(std::ranges::any_of(seen.crossings, &crossing_user::goes_first));
}
