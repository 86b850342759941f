// Maps of lanelets: Lanelet2 and CommonRoad.
#include "base/input_error.hpp"
#include "tests/maps/files.hpp"

namespace sofof::maps_tests::lanelets {

TEST_CASE("lanelets of Lanelet2 become lanes, whichever way bounds are drawn") {
  const auto map = imported("fork.osm");
  check_drivable(map);
  REQUIRE(map.lanes.size() == 5);
  CHECK(lane_of(map, "1000").next == std::vector<std::string>{"1001", "1002"});
  CHECK(lane_of(map, "1000").half_width_m
        == doctest::Approx(1.5).epsilon(0.02));
  const auto& first = lane_of(map, "1000").centre;
  CHECK(first.back().x_m - first.front().x_m
        == doctest::Approx(60).epsilon(0.01));
}

TEST_CASE("a lanelet of both directions becomes two lanes") {
  const auto map = imported("fork.osm");
  const auto& there = lane_of(map, "1003");
  const auto& back = lane_of(map, "1003 back");
  CHECK(distance_m(there.centre.front(), back.centre.back()) < 0.1);
  CHECK(there.limits.front().limit_mps == doctest::Approx(100 / 3.6));
}

TEST_CASE("tags of Lanelet2 say limits and who yields") {
  const auto map = imported("fork.osm");
  CHECK(lane_of(map, "1000").limits.front().limit_mps
        == doctest::Approx(50 / 3.6));
  CHECK(lane_of(map, "1001").limits.front().limit_mps
        == doctest::Approx(30 / 3.6));
  CHECK(lane_of(map, "1001").rank == 0);
  CHECK(lane_of(map, "1002").rank == 1);
  CHECK(map.left_out.at("lanelets that are no road") == 1);
  CHECK(map.left_out.at("traffic lights") == 1);
}

TEST_CASE("nodes have places on earth, or in a plane of their own") {
  const auto globe = imported("fork.osm");
  const auto plane = imported("fork_local.osm");
  REQUIRE(globe.origin);
  CHECK(globe.origin->utm_zone == 32);
  CHECK(!plane.origin);
  check_drivable(plane);
  const auto far_m = distance_m(lane_of(globe, "1000").centre.front(),
                                lane_of(globe, "1001").centre.back());
  CHECK(far_m == doctest::Approx(120).epsilon(0.01));
}

TEST_CASE("lanelets of CommonRoad become lanes with their successors") {
  const auto map = imported("fork.xml");
  check_drivable(map);
  REQUIRE(map.lanes.size() == 4);
  CHECK(lane_of(map, "1").next == std::vector<std::string>{"2", "3"});
  CHECK(lane_of(map, "3").next == std::vector<std::string>{"4"});
  CHECK(lane_of(map, "1").limits.front().limit_mps == doctest::Approx(11.11));
  CHECK(lane_of(map, "2").limits.front().limit_mps
        == doctest::Approx(50 / 3.6));
  CHECK(lane_of(map, "4").limits.front().limit_mps == doctest::Approx(8.33));
  CHECK(map.left_out
        == maps::tally{{"lanes closed to cars", 1},
                       {"obstacles", 1},
                       {"planning problems", 1}});
}

TEST_CASE("a successor that is not there is refused with the place") {
  auto text = text_of("fork.xml");
  const auto at = text.find("ref=\"4\"");
  text.replace(at, 7, "ref=\"9\"");
  CHECK_THROWS_WITH_AS(imported(text, "f.xml"),
                       doctest::Contains("there is no lanelet \"9\"."),
                       input_error);
}

} // namespace sofof::maps_tests::lanelets
