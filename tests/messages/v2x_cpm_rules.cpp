// When CPMs are sent, and which objects go into them (TS 103 324, 6.1).
#include "messages/v2x/cpm_rules.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace std::chrono_literals;

namespace {

constexpr time_point first_cpm{20s};

known_object known_car(std::uint32_t id, point at, double speed_mps = 0,
                       double heading_rad = 0) {
  return {id, {at, heading_rad, speed_mps, 0, 5.1, 1.89}};
}

using indices = std::vector<std::uint32_t>;

/// What goes into a CPM; nothing when there is none.
indices told_objects(cpm_trigger& trigger, time_point at,
                     const std::vector<known_object>& seen) {
  const auto now = trigger.check(at, seen);
  return {now.objects.begin(), now.objects.end()};
}

} // namespace

TEST_CASE("an object is told of when it is new, and then once a second") {
  cpm_trigger trigger;
  const std::vector seen{known_car(1, {10, 0})};
  CHECK(told_objects(trigger, first_cpm, seen) == indices{0});
  for (auto i = 1; i < 10; ++i)
    CHECK(told_objects(trigger, first_cpm + i * 100ms, seen).empty());
  CHECK(told_objects(trigger, first_cpm + 1s, seen) == indices{0});
}

TEST_CASE("each object is told of when its own motion is news") {
  cpm_trigger trigger;
  told_objects(trigger, first_cpm,
               {known_car(1, {0, 0}), known_car(2, {0, 10}, 5),
                known_car(3, {0, 20}, 5), known_car(4, {})});
  CHECK(told_objects(trigger, first_cpm + 100ms,
                     {known_car(1, {4.01, 0}), known_car(2, {0, 10}, 5.51),
                      known_car(3, {0, 20}, 5, 0.07),
                      known_car(4, {3.99, 0}, 0.49, 0.069)})
        == indices{0, 1, 2});
}

TEST_CASE("an object that creeps is told of by what was told, not seen") {
  cpm_trigger trigger;
  auto sent = 0;
  for (auto i = 0; i < 10; ++i) // 9 m in all
    sent += told_objects(trigger, first_cpm + i * 100ms,
                         {known_car(1, {1.0 * i, 0})})
                    .empty()
                ? 0
                : 1;
  CHECK(sent == 2);
}

TEST_CASE("objects are known by their ids, not by their order") {
  cpm_trigger trigger;
  told_objects(trigger, first_cpm,
               {known_car(7, {0, 0}), known_car(3, {50, 0})});
  CHECK(told_objects(trigger, first_cpm + 100ms,
                     {known_car(3, {50, 0}), known_car(5, {90, 0}),
                      known_car(7, {0, 0})})
        == indices{1});
}

TEST_CASE("who vanishes is forgotten, and new when it comes back") {
  cpm_trigger trigger;
  const std::vector seen{known_car(1, {})};
  told_objects(trigger, first_cpm, seen);
  CHECK(told_objects(trigger, first_cpm + 100ms, {}).empty());
  CHECK(told_objects(trigger, first_cpm + 200ms, seen) == indices{0});
}

TEST_CASE("without news there is no CPM but once a second") {
  cpm_trigger trigger;
  std::vector<int> sent;
  for (auto ms = 0; ms <= 2000; ms += 100)
    if (trigger.check(first_cpm + ms * 1ms, {}).send)
      sent.push_back(ms);
  CHECK(sent == std::vector{0, 1000, 2000});
}

TEST_CASE("sensors are told of once a second, whoever drives by") {
  cpm_trigger trigger;
  std::vector<int> with;
  for (auto ms = 0; ms <= 2000; ms += 100) {
    const std::vector seen{known_car(1, {0.05 * ms, 0}, 50)};
    const auto now = trigger.check(first_cpm + ms * 1ms, seen);
    CHECK(now.send);
    if (now.sensor_information)
      with.push_back(ms);
  }
  CHECK(with == std::vector{0, 1000, 2000});
}

TEST_CASE("no two CPMs are closer than their period") {
  for (const auto rule :
       {generation_rule::triggered, generation_rule::fixed_10hz}) {
    cpm_trigger trigger{rule};
    auto sent = 0;
    for (auto ms = 0; ms < 1000; ms += 10)
      if (trigger
              .check(first_cpm + ms * 1ms,
                     std::vector{known_car(1, {1.0 * ms, 0})})
              .send)
        ++sent;
    CHECK(sent == 10);
  }
  cpm_trigger slow{generation_rule::triggered, 500ms};
  CHECK(told_objects(slow, first_cpm, {known_car(1, {})}) == indices{0});
  CHECK(told_objects(slow, first_cpm + 400ms, {known_car(1, {50, 0})}).empty());
  CHECK(told_objects(slow, first_cpm + 500ms, {known_car(1, {50, 0})})
        == indices{0});
}

TEST_CASE("by the clock, everything is told ten times a second") {
  cpm_trigger trigger{generation_rule::fixed_10hz};
  const std::vector seen{known_car(1, {}), known_car(2, {9, 0})};
  for (auto i = 0; i < 5; ++i)
    CHECK(told_objects(trigger, first_cpm + i * 100ms, seen) == indices{0, 1});
  CHECK(trigger.check(first_cpm + 500ms, {}).send);
}

TEST_CASE("of too many objects those that wait for longest go first") {
  cpm_trigger trigger;
  std::vector<known_object> crowd;
  for (auto i = 0U; i < 200; ++i)
    crowd.push_back(known_car(1000 - i, {10.0 * i, 0}));
  const auto first = told_objects(trigger, first_cpm, crowd);
  REQUIRE(first.size() == cpm_trigger::most_objects);
  CHECK(std::ranges::is_sorted(first));
  CHECK(first.front() == 72); // all are new: the lower ids
  const auto second = told_objects(trigger, first_cpm + 100ms, crowd);
  REQUIRE(second.size() == 72);
  CHECK(second.back() == 71);
  CHECK(told_objects(trigger, first_cpm + 200ms, crowd).empty());

  cpm_trigger steady{generation_rule::fixed_10hz}; // in turns
  told_objects(steady, first_cpm, crowd);
  const auto next = told_objects(steady, first_cpm + 100ms, crowd);
  REQUIRE(next.size() == cpm_trigger::most_objects);
  CHECK(next.front() == 0);
  CHECK(std::ranges::count_if(next, [](auto i) { return i < 72; }) == 72);
}
