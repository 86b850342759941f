// The made-up town: its streets, its turns and the ways round its blocks.
#include "world/roads/street_grid.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>

using namespace sofof;
using namespace sofof::world;

namespace {

const streets& town() {
  static const auto grid = make_street_grid({});
  return *grid;
}

/// Four by three junctions: small enough to look at everything.
const streets& village() {
  static const auto grid = make_street_grid({4, 3, 100, 10, 1.75});
  return *grid;
}

const lane& find_lane(const road_map& map, std::string_view name) {
  return *std::ranges::find(map.lanes(), name, &lane::name);
}

bool is_street(const lane& l) {
  return l.name.find('>') == std::string::npos;
}

double lanes_m(const road_map& map, bool streets_only) {
  auto sum = 0.0;
  for (const auto& l : map.lanes())
    if (!streets_only || is_street(l))
      sum += length_m(l.centre);
  return sum;
}

} // namespace

TEST_CASE("the town as it comes holds more than 100 km of lane") {
  CHECK(lanes_m(town().map, true) > 100e3);
  CHECK(lanes_m(town().map, false) == doctest::Approx(188e3).epsilon(0.01));
}

TEST_CASE("streets are two-way, 3.5 m apart, and keep to the right") {
  const auto& map = village().map;
  const auto& there = find_lane(map, "1.1e");
  const auto& back = find_lane(map, "2.1w");
  CHECK(there.centre.front() == point{115, 98.25});
  CHECK(there.centre.back() == point{185, 98.25});
  CHECK(back.centre.front() == point{185, 101.75});
  CHECK(back.centre.back() == point{115, 101.75});
  CHECK(find_lane(map, "1.1n").centre.front() == point{101.75, 115});
}

TEST_CASE("a lane looks the same from either end, turns too") {
  for (const auto& lane : village().map.lanes()) {
    const auto& c = lane.centre;
    const auto last = c.size() - 1;
    for (std::size_t k = 0; k < last; ++k)
      CHECK(distance_m(c[k], c[k + 1])
            == doctest::Approx(distance_m(c[last - k], c[last - k - 1]))
                   .epsilon(1e-3));
  }
}

TEST_CASE("over an inner junction there are three ways on, at a corner one") {
  const auto& map = village().map;
  CHECK(find_lane(map, "0.1e").next.size() == 3);
  CHECK(find_lane(map, "2.1e").next
        == std::vector<std::string>{"3.1e>s", "3.1e>n"});
  CHECK(find_lane(map, "2.0e").next == std::vector<std::string>{"3.0e>n"});
  // 17 streets both ways; 2 inner junctions with 12 ways over them, 6 on the
  // rim with 6, 4 corners with 2.
  CHECK(map.lanes().size() == 34 + 24 + 36 + 8);
}

TEST_CASE("east-west streets go first, left turns wait") {
  const auto& map = village().map;
  CHECK(find_lane(map, "1.1e>e").rank == 0);
  CHECK(find_lane(map, "1.1w>n").rank == 0);
  CHECK(find_lane(map, "1.1e>n").rank == 1);
  CHECK(find_lane(map, "1.1n>n").rank == 2);
  CHECK(find_lane(map, "1.1n>w").rank == 3);
}

TEST_CASE("lanes conflict on junctions only, never along the streets") {
  const auto lanes = village().map.lanes();
  CHECK_FALSE(village().map.conflicts().empty());
  for (const auto& c : village().map.conflicts()) {
    CHECK_FALSE(is_street(lanes[c.lane_a]));
    CHECK_FALSE(is_street(lanes[c.lane_b]));
  }
}

TEST_CASE("an inner junction has the conflicts of any four-way crossing") {
  const auto lanes = village().map.lanes();
  std::map<conflict::kind, int> count;
  auto opposite_lefts = 0;
  for (const auto& c : village().map.conflicts()) {
    const auto &a = lanes[c.lane_a].name, &b = lanes[c.lane_b].name;
    if (!a.starts_with("1.1") || !b.starts_with("1.1"))
      continue;
    ++count[c.how];
    opposite_lefts += a == "1.1e>n" && b == "1.1w>s";
  }
  // Three lanes begin in each of four, and three end in each of four.
  CHECK(count[conflict::kind::diverge] == 12);
  CHECK(count[conflict::kind::merge] == 12);
  // Straight on: 4. A left turn: the oncoming lane, the one from the left,
  // and the left turns from both sides, shared between two.
  CHECK(count[conflict::kind::crossing] == 4 + 4 * 2 + 4);
  CHECK(opposite_lefts == 0);
}

TEST_CASE("every route is closed and can be driven") {
  CHECK(town().routes.size() > 300);
  auto sharpest = 0.0, jump = 0.0;
  for (const auto& way : town().routes) {
    REQUIRE(way->closed());
    auto last = way->path().at(-0.5).curvature_1pm;
    for (auto s_m = 0.0; s_m < way->length_m(); s_m += 0.5) {
      const auto here = way->path().at(s_m).curvature_1pm;
      sharpest = std::max(sharpest, std::abs(here));
      jump = std::max(jump, std::abs(here - last));
      last = here;
    }
  }
  CHECK(sharpest < 1.0 / 6);
  CHECK(jump < 0.02); // 0.04 1/m a metre
}

TEST_CASE("routes keep to the middle of their lanes") {
  for (const auto& way : village().routes)
    for (auto s_m = 0.0; s_m < way->length_m(); s_m += 1) {
      const auto [lane, on_lane_m] = way->at_lane(s_m);
      const path centre{village().map.lanes()[lane].centre};
      CHECK(distance_m(centre.at(on_lane_m).at, way->path().at(s_m).at) < 0.05);
    }
}

TEST_CASE("the routes cover the town evenly") {
  std::vector<int> visits(town().map.lanes().size());
  for (const auto& way : town().routes)
    for (const auto i : way->sequence())
      ++visits[i];
  auto unseen = 0, busiest = 0, streets = 0;
  for (std::size_t i = 0; i < visits.size(); ++i)
    if (is_street(town().map.lanes()[i])) {
      ++streets;
      unseen += visits[i] == 0;
      busiest = std::max(busiest, visits[i]);
    }
  CHECK(streets == 960);
  CHECK(unseen < 0.05 * streets); // some on the rim
  CHECK(busiest <= 7);
}

TEST_CASE("tours go straight over junctions, some of them turn left") {
  auto straight_on = 0, left = 0, right = 0;
  for (const auto& way : town().routes) {
    const auto turned = way->path().at(way->length_m()).heading_rad
                        - way->path().at(0).heading_rad;
    (turned > 0 ? left : right) += 1;
    if (way->name().starts_with("block"))
      CHECK(way->sequence().size() == 8);
    else
      ++straight_on;
  }
  CHECK(straight_on > 100);
  CHECK(left > 30);
  CHECK(right > left);
}

TEST_CASE("the same parameters give the same town") {
  const auto again = make_street_grid({});
  REQUIRE(again->routes.size() == town().routes.size());
  for (std::size_t i = 0; i < again->routes.size(); ++i) {
    CHECK(again->routes[i]->name() == town().routes[i]->name());
    CHECK(std::ranges::equal(again->routes[i]->sequence(),
                             town().routes[i]->sequence()));
  }
}

TEST_CASE("the smallest town is one block; smaller ones are refused") {
  const auto block = make_street_grid({2, 2, 60, 10, 1.5});
  CHECK(block->map.lanes().size() == 16);
  REQUIRE(block->find("block 0.0"));
  CHECK_THROWS_AS(make_street_grid({1, 9, 100, 10, 1.75}),
                  std::invalid_argument);
  CHECK_THROWS_AS(make_street_grid({9, 9, 20, 10, 1.75}),
                  std::invalid_argument);
  CHECK_THROWS_AS(make_street_grid({9, 9, 100, 0, 1.75}),
                  std::invalid_argument);
}
