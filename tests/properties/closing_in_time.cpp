// How soon one side of a session closes what the other side has closed: with
// one provider or two at once, a hedge, loss, and times in which nothing gets
// through.
#include "tests/properties/actor_world.hpp"
#include "tests/properties/library_world.hpp"
#include "tests/properties/two_at_once.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

using namespace sofof;
using namespace sofof::channel;
using namespace sofof::messages;
using namespace sofof::test;

namespace {

/// How late sides have been.
struct lateness {
  int episodes = 0, above_2_s = 0, above_5_s = 0;
  std::uint64_t steps = 0; // of the protocol, checked against its rules
  duration longest{};

  void add(duration late) {
    ++episodes;
    above_2_s += late > 2s;
    above_5_s += late > 5s;
    longest = std::max(longest, late);
  }
};

/// @returns the first moment from `t` on at which something gets through.
time_point carries_from(time_point t, const conduct& of) {
  for (const auto& outage : of.outages)
    if (time_point{outage.from} <= t && t < time_point{outage.to})
      t = time_point{outage.to};
  return t;
}

/// Adds each session that both sides have had, from the first moment after its
/// first end at which the link carried.
void add(const ledger& book, const conduct& of, lateness& to) {
  for (const auto& [session, left] : book.left) {
    const auto freed = book.freed.find(session);
    REQUIRE(freed != book.freed.end());
    const auto [first, last] = std::minmax(left, freed->second);
    to.add(std::max(last - carries_from(first, of), duration{0}));
  }
}

/// A number of worlds; SOFOF_PROTOCOL_SEEDS asks for more, or for fewer.
std::uint64_t seeds() {
  const auto* wanted = std::getenv("SOFOF_PROTOCOL_SEEDS");
  return wanted ? std::strtoull(wanted, nullptr, 10) : 6;
}

template <class World>
lateness late_by(double loss, const conduct& of, std::uint64_t seed) {
  lateness late;
  World w{seed, {loss, 0, 0, {}}, 3, "paper_5g", of};
  w.run_and_check(200s);
  w.dismiss();
  w.diary->finish();
  for (const auto& text : w.diary->broken)
    FAIL_CHECK(text);
  late.steps += w.diary->trace.steps();
  add(*w.book, of, late);
  return late;
}

/// Drives `seeds()` worlds, prints how late sides were, and checks that few
/// were by 2 s and none by 5 s.
template <class World>
void check_in_time(std::string_view what, double loss, const auto& conduct_of) {
  lateness all;
  for (std::uint64_t seed = 1; seed <= seeds(); ++seed) {
    CAPTURE(seed);
    const auto late = late_by<World>(loss, conduct_of(seed), seed);
    all.episodes += late.episodes;
    all.steps += late.steps;
    all.above_2_s += late.above_2_s;
    all.above_5_s += late.above_5_s;
    all.longest = std::max(all.longest, late.longest);
  }
  MESSAGE(what << ", " << World::kind << ", loss " << loss << ": episodes "
               << all.episodes << ", later than 2 s " << all.above_2_s
               << ", than 5 s " << all.above_5_s << ", longest "
               << to_seconds(all.longest) << " s, steps " << all.steps);
  CHECK(all.episodes > 50 * static_cast<int>(seeds()));
  CHECK(all.above_2_s * 1000 <= all.episodes);
  CHECK(all.above_5_s == 0);
}

/// Outages of 0.1 to 6 s, 5 to 25 s apart.
conduct interrupted(conduct of, std::uint64_t seed) {
  dice random{seed};
  for (auto t = from_seconds(random.between(5, 25)); t < 200s;) {
    const auto end = t + from_seconds(random.between(0.1, 6));
    of.outages.push_back({t, end});
    t = end + from_seconds(random.between(5, 25));
  }
  return of;
}

} // namespace

TEST_CASE_TEMPLATE("what one side closed the other one closes soon: one "
                   "provider at a time",
                   World, actor_world, library_world) {
  for (const auto loss : {0.02, 0.1})
    check_in_time<World>("one at a time", loss,
                         [](std::uint64_t) { return conduct{}; });
}

TEST_CASE_TEMPLATE("what one side closed the other one closes soon: two "
                   "providers at once",
                   World, actor_world, library_world) {
  check_in_time<World>("two at once", 0.1,
                       [](std::uint64_t) { return with_two(0ms); });
}

TEST_CASE_TEMPLATE("what one side closed the other one closes soon: a provider "
                   "stands by",
                   World, actor_world, library_world) {
  for (const auto hedge_after : {20ms, 45ms})
    check_in_time<World>(
        fmt::format("standby after {} ms", hedge_after.count()), 0.1,
        [=](std::uint64_t) { return with_two(hedge_after); });
}

TEST_CASE_TEMPLATE("what one side closed the other one closes soon after an "
                   "outage",
                   World, actor_world, library_world) {
  for (const auto hedge_after : {0ms, 20ms})
    check_in_time<World>(
        fmt::format("outages, standby after {} ms", hedge_after.count()), 0.1,
        [=](std::uint64_t seed) {
          return interrupted(with_two(hedge_after), seed);
        });
}
