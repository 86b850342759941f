// Where bodies rest: known from all sightings since they moved.
#include "base/random.hpp"
#include "planners/scene/object_tracker.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace sofof;
using namespace sofof::planners;
using namespace sofof::world;
using namespace std::chrono_literals;

namespace {

constexpr time_point first_look{100s};

/// As the rules for CPMs have it.
constexpr sighting_rhythm cpm_rhythm{4, 1s};

} // namespace

TEST_CASE("the true sides of what stands lie within its margin") {
  for (const auto noise_m : {0.1, 0.2, 0.3}) {
    CAPTURE(noise_m);
    const sighting_noise noise{noise_m, 0.1, 0.03};
    const random_stream eyes{7, "standing bodies"};
    auto seen = 0, outside = 0;
    for (std::uint64_t body = 0; body < 100; ++body) {
      object_tracker tracker{noise, cpm_rhythm};
      const auto draws = eyes.part(body);
      const auto length_m = 0.1 + 49.9 * draws.uniform(0, 9);
      const auto width_m = 0.1 + 3 * draws.uniform(1, 9);
      for (std::uint64_t k = 0; k < 100; ++k) {
        const point centre{draws.normal(0, noise_m, k, 0),
                           draws.normal(0, noise_m, k, 1)};
        const perceived_object o{centre,
                                 draws.normal(0, 0.03, k, 2),
                                 draws.normal(0, 0.1, k, 3),
                                 0,
                                 length_m,
                                 width_m};
        tracker.update(first_look + k * 50ms, {&o, 1});
        for (const auto& x : tracker.tracks())
          for (const auto end : {-0.5, 0.5}) {
            const auto side_m = x.centre().y_m
                                + end * length_m * std::sin(x.heading_rad)
                                + width_m / 2 * std::cos(x.heading_rad);
            ++seen;
            outside += std::abs(side_m - width_m / 2) > x.margin_m();
          }
      }
    }
    CHECK(seen >= 19000);
    CHECK(outside <= 0.005 * seen);
  }
}

TEST_CASE("where a body stands is known the better the longer it does") {
  object_tracker tracker{{0.2, 0.3, 0.03}, {4, 1s}};
  const random_stream eyes{11, "a parked car"};
  for (std::uint64_t k = 0; k < 30; ++k) { // told once a second, as CPMs do
    const perceived_object o{
        {20 + eyes.normal(0, 0.2, k, 0), 1 + eyes.normal(0, 0.2, k, 1)},
        0.03 * eyes.normal(0, 1, k, 2),
        eyes.normal(0, 0.3, k, 3),
        0,
        1.6,
        1.9};
    tracker.update(first_look + k * 1s, {&o, 1});
  }
  REQUIRE(tracker.tracks().size() == 1);
  const auto& parked = tracker.tracks()[0];
  CHECK(parked.rest->variance_m2 < 0.05 * 0.05);
  CHECK(distance_m(parked.rest->centre, {20, 1}) < 0.15);
}

TEST_CASE("a body that sets off is where it is seen, not where it stood") {
  object_tracker tracker{{0.2, 0.3, 0.03}, cpm_rhythm};
  const random_stream eyes{12, "a car that sets off"};
  auto most_behind_m = 0.0;
  for (std::uint64_t k = 0; k < 600; ++k) { // stands for 20 s, then 1 m/s2
    const auto since_s = std::max(0.0, 0.05 * static_cast<double>(k) - 20);
    const auto x_m = 0.5 * since_s * since_s;
    const perceived_object o{
        {x_m + eyes.normal(0, 0.2, k, 0), eyes.normal(0, 0.2, k, 1)},
        0.03 * eyes.normal(0, 1, k, 2),
        since_s + eyes.normal(0, 0.3, k, 3),
        1,
        4,
        2};
    tracker.update(first_look + k * 50ms, {&o, 1});
    REQUIRE(tracker.tracks().size() == 1);
    if (since_s > 0)
      most_behind_m = std::max(
          most_behind_m, std::abs(tracker.tracks()[0].centre().x_m - x_m));
  }
  CHECK(most_behind_m < 0.5);
}

TEST_CASE("what stands keeps its sides while it is not seen") {
  object_tracker tracker{{0.2, 0.1, 0.03}, cpm_rhythm};
  const perceived_object o{{20, 1}, 0, 0, 0, 4, 2};
  for (auto k = 0; k < 40; ++k)
    tracker.update(first_look + k * 50ms, {&o, 1});
  const auto seen = tracker.tracks()[0];
  const auto later = predict(seen, seen.at + 900ms);
  CHECK(later.motion.covariance(0, 0) > 2 * seen.motion.covariance(0, 0));
  CHECK(later.margin_m() == seen.margin_m());
}
