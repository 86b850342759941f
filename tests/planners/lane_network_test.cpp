// Who is on which lane, and which conflicts it drives towards.
#include "planners/scene/lane_network.hpp"

#include "tests/support/near.hpp"
#include "tests/support/toy_streets.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::planners;
using namespace sofof::world;
using std::numbers::pi;

namespace {

/// Four arms around a junction at (0, 0); east-bound traffic drives at
/// y = -1.75 m.
const road_map& cross_roads() {
  static const auto map = toy::cross_roads();
  return map;
}

const lane_network& lanes() {
  static const lane_network all{cross_roads()};
  return all;
}

std::set<std::string> names(point at, double heading_rad) {
  std::set<std::string> found;
  for (const auto& p : lanes().find({at, heading_rad, 5, 2}))
    found.insert(cross_roads().lanes()[p.lane].name);
  return found;
}

track make_track(point centre, double heading_rad, double speed_mps) {
  track x;
  x.motion.mean << centre.x_m, speed_mps * std::cos(heading_rad), centre.y_m,
      speed_mps * std::sin(heading_rad);
  x.heading_rad = heading_rad;
  x.length_m = 5;
  x.width_m = 2;
  return x;
}

std::vector<conflict_visit> foresee(const track& x, double within_m) {
  std::vector<conflict_visit> found;
  lanes().foresee(x, within_m, found);
  return found;
}

/// @returns the conflict of two lanes, from the side of the first.
conflict_side find_encounter(const std::string& lane,
                             const std::string& other) {
  const auto index = [](const std::string& name) {
    const auto all = cross_roads().lanes();
    return static_cast<std::size_t>(std::ranges::find(all, name, &lane::name)
                                    - all.begin());
  };
  const auto& all = lanes().meetings()[index(lane)];
  return *std::ranges::find(all, index(other), &conflict_side::other_lane);
}

} // namespace

TEST_CASE("a body is on the lane that runs its way") {
  using set = std::set<std::string>;
  CHECK(names({-60, -1.75}, 0) == set{"3>0"});
  CHECK(names({-60, -0.5}, 0.3) == set{"3>0"});
  CHECK(names({-60, 1.75}, pi) == set{"0>3"});
  CHECK(names({-60, -1.75}, pi).empty());
  CHECK(names({-60, -1.75}, pi / 2).empty());
  CHECK(names({-60, -3.6}, 0).empty());
}

TEST_CASE("where lanes begin, a body is on all of them") {
  CHECK(names({-11, -1.75}, 0)
        == std::set<std::string>{"3>0>1", "3>0>2", "3>0>4"});
}

TEST_CASE("a body knows its arc length on a lane") {
  const auto found = lanes().find({{-60, -1}, 0, 5, 2});
  REQUIRE(found.count == 1);
  CHECK(found.all[0].s_m == test::near(150 - 12 - 60, 1e-6));
}

TEST_CASE("who drives towards a junction meets conflicts on all its ways") {
  const auto found = foresee(make_track({-50, -1.75}, 0, 10), 100);
  auto expect = [&](const std::string& lane, const std::string& other) {
    const auto e = find_encounter(lane, other);
    const auto a = std::ranges::find(found, e.side, &conflict_visit::side);
    REQUIRE(a != found.end());
    // The lane begins 38 m from the centre, 35.5 m from the front.
    CHECK(a->way_m == test::near(35.5 + e.from_m, 1e-6));
    CHECK(a->enter_s == test::near((35.5 + e.from_m) / 10, 1e-6));
    CHECK(a->leave_s == test::near((40.5 + e.to_m) / 10, 1e-6));
    CHECK(a->rank == e.rank);
  };
  expect("3>0>1", "4>0>2");
  expect("3>0>2", "1>0>3");
  expect("3>0>4", "1>0>4");
  std::set<std::uint32_t> sides;
  for (const auto& a : found)
    sides.insert(a.side);
  CHECK(sides.size() == found.size());
}

TEST_CASE("who is too fast for a bend does not take it") {
  const auto sides_of = [](double x_m, double speed_mps) {
    std::set<std::string> lanes_taken;
    for (const auto& a : foresee(make_track({x_m, -1.75}, 0, speed_mps), 60))
      for (const auto* turn : {"3>0>1", "3>0>2", "3>0>4"})
        for (const auto& e : lanes().meetings()[static_cast<std::size_t>(
                 std::ranges::find(cross_roads().lanes(), turn, &lane::name)
                 - cross_roads().lanes().begin())])
          if (e.side == a.side)
            lanes_taken.insert(turn);
    return lanes_taken;
  };
  CHECK(sides_of(-40, 10).contains("3>0>2"));
  CHECK_FALSE(sides_of(-14, 13).contains("3>0>2"));
  CHECK(sides_of(-14, 13).contains("3>0>1"));
  CHECK(sides_of(-14, 6).contains("3>0>2"));
}

TEST_CASE("nobody looks farther than asked") {
  CHECK(foresee(make_track({-50, -1.75}, 0, 10), 35).empty());
  CHECK_FALSE(foresee(make_track({-50, -1.75}, 0, 10), 45).empty());
}

TEST_CASE("who stands before a conflict may set off, who stands farther away "
          "drives towards nothing") {
  CHECK(foresee(make_track({-20, -1.75}, 0, 0), 100).empty());
  const auto found = foresee(make_track({-14, -1.75}, 0, 0), 100);
  REQUIRE_FALSE(found.empty());
  for (const auto& a : found) {
    CHECK(a.sets_off);
    CHECK(a.way_m > 0);
    CHECK(a.way_m <= lane_network::at_line_m);
    CHECK(a.enter_s == doctest::Approx(0.5 + std::sqrt(2 * a.way_m / 1.5)));
    CHECK(a.leave_s > a.enter_s);
  }
}

TEST_CASE("who stands on a conflict does not leave it") {
  const auto found = foresee(make_track({1.75, -1.75}, 0, 0), 100);
  const auto e = find_encounter("3>0>1", "4>0>2");
  const auto a = std::ranges::find(found, e.side, &conflict_visit::side);
  REQUIRE(a != found.end());
  CHECK(a->enter_s == 0);
  CHECK(std::isinf(a->leave_s));
}

TEST_CASE("a conflict is left with the rear, even from the next lane") {
  const auto e = find_encounter("3>0>1", "4>0>1"); // to the lane's end, 12 m
  auto rest_s = [&](double x_m) {
    const auto found = foresee(make_track({x_m, -1.75}, 0, 5), 100);
    const auto a = std::ranges::find(found, e.side, &conflict_visit::side);
    return a == found.end() ? 0 : a->leave_s;
  };
  CHECK(rest_s(11) == test::near(3.5 / 5, 1e-6));
  CHECK(rest_s(13) == test::near(1.5 / 5, 1e-6));
  CHECK(rest_s(15) == 0);
}
