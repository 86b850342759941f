// Distances of Responsibility-Sensitive Safety, against the worst that may
// happen, step by step.
#include "planners/safety/rss.hpp"

#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <string>

using namespace sofof;
using namespace sofof::planners;
using test::dice;

namespace {

/// A point that moves at a constant acceleration over each step.
struct mover {
  double at_m, speed_mps;

  void step(double accel_mps2, double dt_s) {
    at_m += dt_s * (speed_mps + 0.5 * accel_mps2 * dt_s);
    speed_mps += accel_mps2 * dt_s;
  }
  /// Stands as soon as it can.
  void brake(double decel_mps2, double dt_s) {
    const auto lasts_s = std::min(dt_s, std::max(0.0, speed_mps) / decel_mps2);
    step(-decel_mps2, lasts_s);
    if (lasts_s < dt_s)
      speed_mps = 0; // also who moves away
  }
};

/// How somebody responds.
struct response {
  double lasts_s;
  double accel_mps2;
  double brake_mps2;

  void step(mover& x, double t_s, double dt_s) const {
    const auto responds_s = std::clamp(lasts_s - t_s, 0.0, dt_s);
    if (responds_s > 0)
      x.step(accel_mps2, responds_s);
    if (responds_s < dt_s)
      x.brake(brake_mps2, dt_s - responds_s);
  }
};

constexpr auto dt_s = 0.02;
constexpr auto lasts_s = 25.0;

/// @returns the least gap to who is ahead and brakes at once.
double least_gap_behind_m(const rss_gap& x, const rss_motion& of,
                          double own_s) {
  mover own{0, x.own_mps}, other{x.gap_m, x.other_mps};
  const response responds{own_s, of.accel_max_mps2, of.brake_min_mps2};
  auto least_m = x.gap_m;
  for (double t = 0; t < lasts_s && (own.speed_mps > 0 || t <= own_s);
       t += dt_s) {
    responds.step(own, t, dt_s);
    other.brake(of.brake_max_mps2, dt_s);
    least_m = std::min(least_m, other.at_m - own.at_m);
  }
  return least_m;
}

/// @returns the least gap to who comes the other way, or from beside.
double least_gap_m(const rss_gap& x, const rss_motion& of, double own_s,
                   double other_s) {
  mover own{0, x.own_mps}, other{0, x.other_mps};
  const response responds{own_s, of.accel_max_mps2, of.brake_min_mps2};
  const response as_well{other_s, of.accel_max_mps2, of.brake_min_mps2};
  auto least_m = x.gap_m;
  for (double t = 0; t < lasts_s
                     && (own.speed_mps != 0 || other.speed_mps != 0
                         || t <= std::max(own_s, other_s));
       t += dt_s) {
    responds.step(own, t, dt_s);
    as_well.step(other, t, dt_s);
    least_m = std::min(least_m, x.gap_m - own.at_m - other.at_m);
  }
  return least_m;
}

/// The same if each responds as late as it may, or at once.
double least_gap_between_m(const rss_gap& x, const rss_motion& of, double own_s,
                           double other_s) {
  return std::min({least_gap_m(x, of, own_s, other_s),
                   least_gap_m(x, of, 0, other_s), least_gap_m(x, of, own_s, 0),
                   least_gap_m(x, of, 0, 0)});
}

std::size_t states() {
  const auto* said = std::getenv("SOFOF_RSS_STATES");
  return said ? std::stoul(said) : 30'000;
}

/// @param least_gap_m  Of a response time.
template <class Simulation>
void check_limit(double longest_s, const Simulation& least_gap_m) {
  constexpr auto rounding_m = 1e-6;
  if (longest_s < 0) {
    CHECK(least_gap_m(0.0) < rounding_m);
    return;
  }
  CHECK(least_gap_m(longest_s) > -rounding_m);
  CHECK(least_gap_m(1.05 * longest_s + 1e-6) < rounding_m);
}

} // namespace

TEST_CASE("the longest response time behind another vehicle is safe whatever "
          "that one does, and 5 % more is not") {
  dice random{1708};
  const rss_motion lon;
  for (std::size_t k = 0; k < states(); ++k) {
    const rss_gap x{random.between(0, 80), random.between(0, 25),
                    random.between(0, 25)};
    CAPTURE(x.gap_m);
    CAPTURE(x.own_mps);
    CAPTURE(x.other_mps);
    check_limit(follows_safely_s(x, lon), [&](double response_s) {
      return least_gap_behind_m(x, lon, response_s);
    });
  }
}

TEST_CASE("so is that towards who comes the other way, or beside who comes "
          "nearer or moves away") {
  dice random{6374};
  const rss_assumptions all;
  for (std::size_t k = 0; k < states(); ++k) {
    const auto is_across = k % 2 == 0;
    const auto& of = is_across ? all.lat : all.lon;
    const auto x = is_across
                       ? rss_gap{random.between(0, 4), random.between(-2, 2),
                                 random.between(-2, 2)}
                       : rss_gap{random.between(0, 200), random.between(0, 25),
                                 random.between(0, 25)};
    CAPTURE(is_across);
    CAPTURE(x.gap_m);
    CAPTURE(x.own_mps);
    CAPTURE(x.other_mps);
    check_limit(
        meets_safely_s(x, of, all.others_response_s), [&](double response_s) {
          return least_gap_between_m(x, of, response_s, all.others_response_s);
        });
  }
}

TEST_CASE("two vehicles that touch are safe under no response time") {
  CHECK(follows_safely_s({-0.1, 0, 10}, {}) < 0);
  CHECK(meets_safely_s({-0.1, -5, -5}, {}, 1) < 0);
}

TEST_CASE("who is far away may be answered late, who is near may not") {
  const rss_motion lon;
  const auto near = follows_safely_s({15, 13.9, 13.9}, lon);
  const auto far = follows_safely_s({40, 13.9, 13.9}, lon);
  CHECK(near > 0.1);
  CHECK(far > near + 1);
  CHECK(farthest_m(13.9, far, lon)
        == doctest::Approx(40 + 13.9 * 13.9 / (2 * 8)));
}
