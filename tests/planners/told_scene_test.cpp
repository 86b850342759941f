// Who of those that a car sees keeps what it has claimed.
#include "planners/scene/told_scene.hpp"

#include "planners/crossing/claim_book.hpp"
#include "tests/support/toy_streets.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::planners;
using namespace std::chrono_literals;

namespace {

constexpr time_point now{10s};

/// To the east, at the origin now.
told_drive claimed(double speed_mps) {
  told_drive x{7, {now - 1s, 200ms, {}}, true, {2.5, 0}};
  for (auto t_s = -1.0; t_s < 4; t_s += 0.2)
    x.drive.bodies.push_back({{speed_mps * t_s, 0}, 0, 5, 2});
  return x;
}

/// @returns whether a car that is so far behind what it has claimed is thought
/// to keep it.
bool is_kept(double speed_mps, double behind_m) {
  other_body car;
  car.x.motion.mean.col(0) << -behind_m, 0;
  car.x.motion.mean.col(1) << speed_mps, 0;
  car.x.length_m = 5;
  car.x.width_m = 2;
  car.x.station = station_id{7};
  auto says = claimed(speed_mps);
  says.front = {2.5 - behind_m, 0};
  std::vector others{car};
  find_those_who_tell(now, std::vector{says}, true, others);
  return others[0].has_claimed;
}

/// @returns where the rear of a lead will be that is seen 30 m down a street to
/// the east with a speed along it, and tells that it drives with 8 m/s in
/// another direction, now so far beside the street's middle.
std::vector<way_moment> told_by_lead(double heading_rad, double beside_m,
                                     double seen_mps) {
  const world::road_map map{
      "street", {}, {toy::straight("lane", {0, 0}, {400, 0})}};
  const std::vector<std::string> lanes{"lane"};
  const auto way = map.make_route("lane", lanes, false);
  const point ahead{std::cos(heading_rad), std::sin(heading_rad)};
  told_drive x{7, {now, 200ms, {}}, true, {}};
  for (auto t_s = 0.0; t_s < 4; t_s += 0.2)
    x.drive.bodies.push_back(
        {point{30, beside_m} + (2.5 + 8 * t_s) * ahead, heading_rad, 5, 2});
  const lead_vehicle lead{station_id{7}, 30, seen_mps, 0};
  std::vector<way_moment> out;
  list_lead(now, *way, lead, 1.2, std::vector{x}, out);
  return out;
}

} // namespace

TEST_CASE(
    "a slow car does not keep its claim if it is so far behind that it has "
    "given it up") {
  const auto most_m = most_behind_m(2);
  CHECK(is_kept(2, most_m)); // it is seen less well than it knows its place
  CHECK_FALSE(is_kept(2, 1.2 * most_m));
}

TEST_CASE("whose claim is kept is less late than claims are apart") {
  const auto apart_s = to_seconds(claim_book::rules{}.apart);
  for (const auto speed_mps : {5.0, 8.0, 12.0}) {
    CHECK(is_kept(speed_mps, 0.25 * speed_mps));
    CHECK_FALSE(is_kept(speed_mps, (apart_s - 0.15) * speed_mps));
  }
}

TEST_CASE("a lead that turns is as fast along the own way as it says") {
  constexpr auto turned_rad = 1.0; // 4.3 of 8 m/s are along the street
  CHECK(told_by_lead(turned_rad, 0, 4).size() > 1);
  CHECK(told_by_lead(turned_rad, 0, 3).empty()); // it brakes
}

TEST_CASE("a lead that turns in from beside the way is minded as it is seen") {
  CHECK(told_by_lead(0.6, -4, 5).empty());
  CHECK(told_by_lead(-0.6, 4, 5).empty());
}

TEST_CASE("a lead that turns off holds nobody up where it is") {
  const auto told = told_by_lead(-1, -4, 4);
  REQUIRE(told.size() == 1);
  CHECK(told[0].s_m == doctest::Approx(30));
  CHECK(told[0].t_s == 0);
}
