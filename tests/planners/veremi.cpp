// The position attacks of VeReMi, told by one car in ten.
#include "tests/support/veremi.hpp"

#include "tests/support/watched_road.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

using namespace sofof;
using namespace sofof::planners;
using namespace sofof::test;
using namespace sofof::world;

namespace {

struct tally {
  std::size_t lies = 0, found = 0;           // all
  std::size_t seen_lies = 0, found_seen = 0; // where a sensor sees the place
  std::size_t accused = 0;                   // honest words

  double precision() const {
    return found + accused == 0 ? 1
                                : static_cast<double>(found)
                                      / static_cast<double>(found + accused);
  }
  double recall() const {
    return static_cast<double>(found) / static_cast<double>(lies);
  }
  double recall_seen() const {
    return static_cast<double>(found_seen) / static_cast<double>(seen_lies);
  }
};

/// Forty cars on two rings, four of which attack, and nine sensors.
class ring {
public:
  static constexpr std::size_t cars = 40;

  ring(veremi kind, std::uint64_t seed) : dice_{seed, "veremi"} {
    for (std::size_t k = 0; k < cars; ++k) {
      road_.cars.push_back({.is = place(k, 0)});
      road_.told.emplace_back();
      attackers_.emplace_back(kind, dice_.part(k), point{-300, -300},
                              point{300, 300}, point{40, -20});
    }
    for (auto x = -1; x <= 1; ++x)
      for (auto y = -1; y <= 1; ++y)
        road_.sensors.push_back({{.range_m = 120},
                                 random_stream{seed, "masts"}.part(
                                     static_cast<std::uint64_t>(3 * x + y + 4)),
                                 {150.0 * x, 150.0 * y},
                                 0,
                                 {}});
  }

  tally drive(duration d) {
    tally all;
    for (auto t = 0ms; t < d; t += 100ms) {
      for (std::size_t k = 0; k < cars; ++k) {
        // The car is moved on by what it tells of its motion until then.
        road_.cars[k].is = moved_on(place(k, to_seconds(t) + 0.1), -0.1);
        road_.told[k].reset();
        if (attacks(k)) {
          const auto real = place(k, to_seconds(t) + 0.1);
          road_.told[k] = attackers_[k].told(real);
        }
      }
      road_.pass(100ms);
      for (std::size_t k = 0; k < cars; ++k)
        count(k, all);
    }
    return all;
  }

private:
  static bool attacks(std::size_t k) { return k % 10 == 0; }

  perceived_object place(std::size_t k, double t_s) const {
    const auto inner = k % 2 == 0;
    const auto radius_m = inner ? 140.0 : 150.0;
    const auto speed_mps = inner ? 8.0 : 10.0;
    const auto angle = 2 * std::numbers::pi * static_cast<double>(k) / cars
                       + (inner ? 1 : -1) * speed_mps * t_s / radius_m;
    return {radius_m * point{std::cos(angle), std::sin(angle)},
            wrap_angle(angle + (inner ? 1 : -1) * std::numbers::pi / 2),
            speed_mps,
            0,
            5.1,
            1.89};
  }

  bool is_seen(const perceived_object& x) {
    const auto body = watched_road::body(999, x);
    scene alone;
    alone.place({&body, 1});
    return std::ranges::any_of(road_.sensors, [&](const sensor& s) {
      return !alone.seen_by(s, road_.now).empty();
    });
  }

  void count(std::size_t k, tally& all) {
    const auto found = road_.doubts.doubts(watched_road::number(k));
    if (!attacks(k) || !attackers_[k].lies()) {
      all.accused += found ? 1 : 0;
      return;
    }
    ++all.lies;
    all.found += found ? 1 : 0;
    if (!is_seen(*road_.told[k]))
      return;
    ++all.seen_lies;
    all.found_seen += found ? 1 : 0;
  }

  random_stream dice_;
  watched_road road_;
  std::vector<veremi_attacker> attackers_;
};

} // namespace

TEST_CASE("VeReMi's attacks by one car in ten are found where sensors see the "
          "place, and no honest car is accused") {
  for (const auto kind : veremi_kinds) {
    CAPTURE(name_of(kind));
    const auto all = ring{kind, 1}.drive(60s);
    MESSAGE(name_of(kind) << ": precision " << all.precision() << ", recall "
                          << all.recall() << ", where sensors see "
                          << all.recall_seen() << " of " << all.seen_lies
                          << " lies");
    REQUIRE(all.seen_lies > 200);
    CHECK(all.recall_seen() >= 0.95);
    CHECK(all.precision() >= 0.99);
  }
}
