// Whose fault a collision is.
#include "experiments/judge/fault.hpp"

#include "world/roads/road_map.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace sofof::faults_of_collisions {

using namespace experiments::judge;

namespace {

const world::road_map& map() {
  static const world::road_map made{"street",
                                    {},
                                    {{.name = "street",
                                      .centre = {{0, 0}, {500, 0}},
                                      .limits = {{0, 20}},
                                      .next = {},
                                      .opposite = {}}}};
  return made;
}

/// Along a straight street, 10 s at constant speed; the end is the touch.
std::vector<driven_moment> along(double speed_mps) {
  std::vector<driven_moment> all;
  for (auto k = 0; k <= 1000; ++k)
    all.push_back({0.01 * k, {{100 + 0.01 * k * speed_mps, 0}, 0, speed_mps}});
  return all;
}

fault fault_with(const std::vector<driven_moment>& drive,
                 std::vector<world::scripted_body::moment> moments) {
  const auto way =
      map().make_route("way", std::vector<std::string>{"street"}, false);
  return whose_fault(drive, *way, {5, 4.5, 1.8, std::move(moments)});
}

} // namespace

TEST_CASE("who stands is not at fault, who rolls is") {
  CHECK_FALSE(
      fault_with(along(0), {{0, {50, 0}, 0, 5}, {10, {104, 0}, 0, 5}}).own);
  CHECK(
      fault_with(along(0.2), {{0, {107, 0}, 0, 0}, {10, {107, 0}, 0, 0}}).own);
}

TEST_CASE("who runs into a car from behind is at fault") {
  const auto end = 100 + 10 * 8.0;
  const auto found =
      fault_with(along(8), {{0, {0, 0}, 0, 17}, {10, {end - 3, 0}, 0, 17}});
  CHECK_FALSE(found.own);
  CHECK(found.why == "from behind");
  CHECK(fault_with(along(8), {{0, {150, 0}, 0, 3}, {10, {end + 6, 0}, 0, 3}})
            .own); // run into by the car
}

TEST_CASE("who cuts in too near is at fault, who does with room is not") {
  const auto end = 100 + 10 * 8.0;
  const auto cut_in_at = [&](double from_s) {
    const auto then_m = end + 5 - (10 - from_s) * 5;
    return fault_with(along(8), {{0, {then_m - from_s * 5, 3.5}, 0, 5},
                                 {from_s - 1, {then_m - 5, 3.5}, 0, 5},
                                 {from_s, {then_m, 0}, 0, 5},
                                 {10, {end + 5, 0}, 0, 5}});
  };
  CHECK_FALSE(cut_in_at(9.9).own);
  CHECK(cut_in_at(5).own);
}

TEST_CASE("who crosses is not who cuts in") {
  const auto end = 100 + 10 * 8.0;
  CHECK(fault_with(along(8), {{8, {end + 4, 20}, -1.57, 10},
                              {10, {end + 4, 0}, -1.57, 10}})
            .own);
}

} // namespace sofof::faults_of_collisions
