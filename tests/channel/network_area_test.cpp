// Places where a channel is worse than elsewhere.
#include "channel/link_direction.hpp"
#include "channel/vehicle_place.hpp"
#include "tests/channel/cycles.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/option_list.hpp"

#include <doctest/doctest.h>

#include <vector>

using namespace sofof;
using namespace sofof::channel;
using test::cycle;
using namespace std::chrono_literals;

namespace {

network_area circle(point at, double radius_m, place_quality quality) {
  network_area area;
  area.position_m = at;
  area.radius_m = radius_m;
  area.quality = quality;
  return area;
}

channel_profile with_areas(std::string_view name,
                           std::vector<network_area> areas) {
  auto profile = *find_channel_profile(name);
  profile.areas = std::move(areas);
  return profile;
}

link_direction link_over(const channel_profile& profile) {
  const random_stream seed{1, "area"};
  return {{std::make_shared<channel_profile>(profile), seed, 1, 0},
          direction::down,
          nullptr};
}

/// @returns how long results take there; nullopt for those that are lost.
std::vector<std::optional<duration>> delays_at(const channel_profile& profile,
                                               const std::optional<point>& at,
                                               std::uint64_t count = 500) {
  auto link = link_over(profile);
  std::vector<std::optional<duration>> all;
  for (std::uint64_t n = 0; n < count; ++n) {
    const auto sent = time_point{n * 1s}; // so that none waits for another
    const auto through =
        link.carry(sent, message_class::result, n, usual_octets, at);
    all.push_back(through.arrives ? std::optional{*through.arrives - sent}
                                  : std::nullopt);
  }
  return all;
}

} // namespace

TEST_CASE("in an area messages take longer, and outside as long as before") {
  const auto usual = delays_at(with_areas("paper_5g", {}), point{0, 0});
  const auto profile =
      with_areas("paper_5g", {circle({0, 0}, 50, {.more_delay = 30ms})});
  CHECK(delays_at(profile, point{51, 0}) == usual);
  CHECK(delays_at(profile, std::nullopt) == usual);
  const auto inside = delays_at(profile, point{50, 0}); // the rim is inside
  for (std::size_t n = 0; n < usual.size(); ++n)
    CHECK(*inside[n] == *usual[n] + 30ms);
}

TEST_CASE("a factor stretches the network's delay, not the time on the air") {
  auto profile = with_areas("ideal", {circle({0, 0}, 1, {{}, 3, 0})});
  profile.network = delay_distribution::uniform(10ms, 20ms);
  const auto near = delays_at(profile, point{0, 0});
  const auto far = delays_at(profile, point{9, 0});
  for (std::size_t n = 0; n < far.size(); ++n)
    CHECK(to_seconds(*near[n]) == doctest::Approx(3 * to_seconds(*far[n])));
}

TEST_CASE("what is lost elsewhere is lost in an area too, and more") {
  auto profile = with_areas("ideal", {circle({0, 0}, 1, {{}, 1, 0.5})});
  profile.loss = 0.2;
  const auto near = delays_at(profile, point{0, 0}, 4000);
  const auto far = delays_at(profile, point{9, 0}, 4000);
  double lost_near = 0;
  for (std::size_t n = 0; n < far.size(); ++n) {
    CHECK((far[n].has_value() || !near[n].has_value()));
    lost_near += !near[n];
  }
  CHECK(lost_near / 4000 == doctest::Approx(1 - 0.8 * 0.5).epsilon(0.05));
}

TEST_CASE("areas that overlap add up, and lose what either loses") {
  const std::vector areas{circle({0, 0}, 10, {10ms, 2, 0.5}),
                          circle({5, 0}, 10, {5ms, 3, 0.5}),
                          circle({99, 0}, 10, {1s, 9, 1})};
  const auto both = quality_at(areas, {2, 0});
  CHECK(both.more_delay == 15ms);
  CHECK(both.delay_factor == 6);
  CHECK(both.loss == doctest::Approx(0.75));
  CHECK(quality_at(areas, {-9, 0}) == areas[0].quality);
  CHECK(quality_at(areas, {50, 0}) == place_quality{});
}

TEST_CASE("whatever areas there are, loss stays a probability and no delay "
          "becomes shorter by more_delay") {
  test::dice random{7};
  for (int round = 0; round < 200; ++round) {
    std::vector<network_area> areas;
    for (int k = 0; k < 5; ++k)
      areas.push_back(circle(
          {random.between(-20, 20), random.between(-20, 20)},
          random.between(1, 30),
          {from_seconds(random.between(0, 0.1)), 1, random.between(0, 1)}));
    const auto there = quality_at(areas, {0, 0});
    CHECK(there.loss >= 0);
    CHECK(there.loss <= 1);
    CHECK(there.slowed(10ms) >= 10ms);
  }
}

TEST_CASE("no message of an area is overtaken by one that is sent outside") {
  auto link = link_over(
      with_areas("ideal", {circle({0, 0}, 1, {.more_delay = 200ms})}));
  const auto first =
      link.carry(cycle(0), message_class::result, 0, usual_octets, point{0, 0});
  const auto second =
      link.carry(cycle(1), message_class::result, 1, usual_octets, point{9, 0});
  CHECK(*first.arrives == cycle(0) + 200ms);
  CHECK(first.by == disturbance::slow);
  CHECK(*second.arrives == *first.arrives);
}

TEST_CASE("a vehicle is nowhere until it says where") {
  vehicle_place place;
  CHECK(!place.last());
  place.tell({1, 2});
  CHECK(place.last() == point{1, 2});
}
