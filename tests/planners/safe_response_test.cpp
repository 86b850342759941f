// The longest response time under which a scene is safe, and for whose sake.
#include "planners/safety/safe_response.hpp"

#include "tests/support/toy_streets.hpp"

#include <doctest/doctest.h>

#include <numbers>
#include <optional>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::planners;
using namespace sofof::world;

namespace {

constexpr auto half_turn = std::numbers::pi;
constexpr auto most_s = 5.0;

/// A straight street to the east; the vehicle's rear axle is 100 m along it.
struct on_a_street {
  route_ptr way = [] {
    const road_map map{
        "street", {}, {toy::straight("street", {0, 0}, {400, 0})}};
    return map.make_route("street", std::vector<std::string>{"street"}, false);
  }();
  double speed_mps = 10;
  double d_m = 0;
  double turned_rad = 0;
  std::vector<perceived_object> objects;
  std::optional<double> stop_at_m;
  bool has_priority = false;
  vehicle_params car;
  rss_assumptions assumed;

  double front_m() const { return 100 + car.front_m; }

  void see(point where, double heading_rad, double its_speed_mps) {
    objects.push_back({where, heading_rad, its_speed_mps, 0, 4.5, 1.8});
  }

  safe_response look() const {
    return longest_safe_response({*way, 100, d_m, turned_rad, speed_mps,
                                  objects, stop_at_m, has_priority},
                                 assumed, car, most_s);
  }
};

} // namespace

TEST_CASE_FIXTURE(on_a_street, "who sees nobody may respond as late as anybody "
                               "wants to know") {
  CHECK(look().longest_s == most_s);
  CHECK(look().because == "free");
}

TEST_CASE_FIXTURE(on_a_street, "behind a car the distance counts, and how fast "
                               "both are") {
  see({front_m() + 20 + 2.25, 0}, 0, 8);
  CHECK(look().because == "follow");
  CHECK(look().longest_s
        == doctest::Approx(follows_safely_s({20, 10, 8}, assumed.lon)));
  speed_mps = 14;
  CHECK(look().longest_s < 0.1);
}

TEST_CASE_FIXTURE(on_a_street, "a car that stands close ahead of one that "
                               "stands leaves some time, though not much") {
  speed_mps = 0;
  see({front_m() + 1 + 2.25, 0}, 0, 0);
  CHECK(look().longest_s > 0.9);
  CHECK(look().longest_s < 1.1);
}

TEST_CASE_FIXTURE(on_a_street, "a car that touches the own one leaves none") {
  see({front_m() + 2.15, 0}, 0, 10);
  CHECK(look().longest_s == 0);
}

TEST_CASE_FIXTURE(on_a_street, "who is behind keeps its distance itself") {
  see({100 - car.rear_m - 0.5 - 2.25, 0}, 0, 20);
  CHECK(look().because == "free");
}

TEST_CASE_FIXTURE(on_a_street, "who comes the other way is no matter in its "
                               "own lane, and in the vehicle's lane it is") {
  see({front_m() + 60, 3.5}, half_turn, 10);
  CHECK(look().longest_s > 1);
  objects.clear();
  see({front_m() + 40, 0}, half_turn, 10);
  CHECK(look().longest_s < 0.5);
  CHECK(look().because == "oncoming");
}

TEST_CASE_FIXTURE(on_a_street, "a car beside the vehicle counts when one of "
                               "them comes nearer") {
  see({103, 3.0}, 0, 10);
  const auto beside_s = look().longest_s;
  CHECK(beside_s > 1);
  turned_rad = 0.05; // to it
  CHECK(look().longest_s < beside_s - 0.3);
  turned_rad = -0.05;
  CHECK(look().longest_s > beside_s);
  turned_rad = 0;
  objects.front().heading_rad = -0.05; // the other one
  CHECK(look().longest_s < beside_s - 0.3);
  objects.front().heading_rad = -0.5;
  CHECK(look().longest_s == 0);
}

TEST_CASE_FIXTURE(on_a_street, "on either side of the lane, and however far "
                               "off its middle, the distance between the "
                               "bodies counts") {
  for (const auto side : {-1.0, 1.0}) {
    CAPTURE(side);
    objects.clear();
    see({103, side * 3.0}, 0, 10);
    d_m = 0;
    turned_rad = 0;
    const auto in_the_middle_s = look().longest_s;
    d_m = side * 0.5;
    CHECK(look().longest_s < in_the_middle_s - 0.3);
    d_m = -side * 0.5;
    CHECK(look().longest_s > in_the_middle_s + 0.3);
  }
}

TEST_CASE_FIXTURE(on_a_street, "who comes from the side and could not stop has "
                               "priority, unless the vehicle has it") {
  see({front_m() + 20, -8}, half_turn / 2, 10);
  CHECK(look().because == "crossing");
  CHECK(look().longest_s
        == doctest::Approx(longest_response_s(10, 20 - 0.9, assumed.lon)));
  has_priority = true;
  CHECK(look().because == "free");
}

TEST_CASE_FIXTURE(on_a_street, "who comes from the side and can stop, or goes "
                               "away, is hardly a matter") {
  see({front_m() + 20, -40}, half_turn / 2, 8);
  CHECK(look().because == "free");
  see({front_m() + 20, 6}, half_turn / 2, 8);
  CHECK(look().longest_s > 4);
}

TEST_CASE_FIXTURE(on_a_street, "who stands close beside the lane and points to "
                               "it may drive on, unless the vehicle has "
                               "priority") {
  see({front_m() + 20, -3.7}, half_turn / 2, 0); // 0.5 m beside
  CHECK(look().longest_s
        == doctest::Approx(longest_response_s(10, 20 - 0.9, assumed.lon)));
  has_priority = true;
  const auto waits_s = look().longest_s;
  CHECK(waits_s > 1.5);
  turned_rad = -0.1; // to it
  CHECK(look().longest_s < waits_s - 0.2);
}

TEST_CASE_FIXTURE(on_a_street, "who turns off or pulls out across the lane is "
                               "still in it, whoever has priority") {
  for (const auto heading_rad : {0.7, half_turn / 2, 2.4})
    for (const auto its_speed_mps : {0.4, 4.0})
      for (const auto has_it : {false, true}) {
        CAPTURE(heading_rad);
        objects.clear();
        see({front_m() + 6, 0}, heading_rad, its_speed_mps);
        has_priority = has_it;
        CHECK(look().longest_s == 0);
      }
}

TEST_CASE_FIXTURE(on_a_street, "a car that stands across the lane is a place "
                               "to stop at, whoever has priority") {
  see({front_m() + 30, 0}, half_turn / 2, 0);
  for (const auto has_it : {false, true}) {
    has_priority = has_it;
    CHECK(look().longest_s
          == doctest::Approx(longest_response_s(10, 30 - 0.9, assumed.lon)));
  }
}

TEST_CASE_FIXTURE(on_a_street, "so is a line that is not granted") {
  stop_at_m = front_m() + 25;
  CHECK(look().because == "line");
  CHECK(look().longest_s
        == doctest::Approx(longest_response_s(10, 25, assumed.lon)));
}

TEST_CASE_FIXTURE(on_a_street, "of several the one that asks for the quickest "
                               "response counts") {
  see({front_m() + 60, 0}, 0, 8);
  see({front_m() + 18, 0}, 0, 8);
  stop_at_m = front_m() + 80;
  CHECK(look().longest_s
        == doctest::Approx(follows_safely_s({18 - 2.25, 10, 8}, assumed.lon)));
}

TEST_CASE_FIXTURE(on_a_street, "a car that faces the vehicle may drive on, "
                               "though it stands") {
  see({front_m() + 20, 0}, 0, 0);
  const auto behind_s = look().longest_s;
  objects.front().heading_rad = half_turn;
  CHECK(look().longest_s < behind_s);
  CHECK(look().because == "oncoming");
}

TEST_CASE_FIXTURE(on_a_street, "faster is never safer on the way to a slower "
                               "car") {
  see({front_m() + 40, 0}, 0, 8);
  auto before_s = most_s;
  for (speed_mps = 0; speed_mps < 20; speed_mps += 0.5) {
    CHECK(look().longest_s <= before_s);
    before_s = look().longest_s;
  }
}
