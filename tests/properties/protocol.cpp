// The promises of the offloading protocol, under loss, delay, duplicates,
// reordering and crashes: over the actors, and over the library alone.
#include "base/protocol.hpp"

#include "tests/properties/actor_world.hpp"
#include "tests/properties/library_world.hpp"
#include "tests/properties/lying_echo.hpp"
#include "tests/properties/two_at_once.hpp"
#include "tests/properties/watchful_policies.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

using namespace sofof;
using namespace sofof::channel;
using namespace sofof::messages;
using namespace sofof::test;

TYPE_TO_STRING(actor_world);
TYPE_TO_STRING(library_world);

namespace {

/// @returns how long one side may have a session that the other one has not
/// any more: in 5 s it is told ten times, each of which may be lost.
duration longest_alone(const link_fault_options& faults) {
  const auto loss = std::max(faults.loss, 0.1);
  return from_seconds(5 / -std::log10(loss)) + 2 * faults.longest_extra_delay;
}

void check_ledger(const ledger& book, duration longest) {
  for (const auto& [session, left] : book.left)
    if (const auto freed = book.freed.find(session);
        freed != book.freed.end()) {
      CAPTURE(session.counter);
      CHECK(to_seconds(left - freed->second) <= to_seconds(longest));
      CHECK(to_seconds(freed->second - left) <= to_seconds(longest));
    }
  for (const auto& [session, times] : book.closed_by_requester)
    CHECK(times == 1);
  for (const auto& [session, times] : book.closed_by_provider)
    CHECK(times == 1);
  // What the requester ran, the provider ran too, and has closed as well.
  for (const auto& [session, times] : book.closed_by_requester)
    CHECK(book.closed_by_provider.contains(session));
}

/// Drives a world through its faults, then dismisses everybody.
template <class World>
ledger live(std::uint64_t seed, const link_fault_options& faults,
            int provider_count, std::optional<duration> crash_at,
            const conduct& of = {}) {
  CAPTURE(seed);
  World w{seed, faults, provider_count, "paper_5g", of};
  if (crash_at) {
    w.run_and_check(*crash_at);
    w.crash_provider();
    w.run_and_check(60s);
  } else {
    w.run_and_check(200s);
  }
  CHECK(w.diary->services.size() == 2);
  w.dismiss();
  w.diary->finish();
  for (const auto& text : w.diary->broken)
    FAIL_CHECK(text);
  if (!crash_at)
    check_ledger(*w.book, longest_alone(faults));
  for (const auto& [session, times] : w.book->closed_by_requester)
    CHECK(times == 1);
  return *w.book;
}

} // namespace

TEST_CASE_TEMPLATE("on a good link a vehicle offloads at every passage, and "
                   "both sides close each episode once",
                   World, actor_world, library_world) {
  const auto book = live<World>(1, {}, 1, std::nullopt);
  CHECK(book.remote_episodes >= 6); // two services, three passages in 200 s
  CHECK(book.reasons.contains(end_reason::left_area));
}

TEST_CASE_TEMPLATE("on a good link a vehicle asks wherever it is heard, once "
                   "a second, and runs nothing outside the area",
                   World, actor_world, library_world) {
  World w{1, {}, 1};
  w.run_and_check(200s);
  w.dismiss();
  // Of 1000 m there and back to the begin, 600 are in the area.
  CHECK(w.book->refusals > 2 * 70);
  CHECK(w.book->refusals <= 2 * 90);
  shuttle car;
  const auto area = area_of_provider(0);
  std::vector<bool> inside; // at each step
  for (auto k = 0; k < 200 * 20; ++k) {
    car.step();
    inside.push_back(area.contains({car.x_m, 0}));
  }
  constexpr auto step = 50ms;
  CHECK(w.book->accepted.size() >= 6);
  for (const auto& [session, since] : w.book->accepted) {
    const auto ends = since + w.book->provider_side.at(session);
    const auto first = since.time_since_epoch() / step;
    const auto last = ends.time_since_epoch() / step;
    for (auto k = first; k + 4 < last; ++k) // a CAM, and its way
      CHECK(inside.at(static_cast<std::size_t>(k)));
  }
}

TEST_CASE_TEMPLATE("whatever a link loses, doubles, delays and reorders: one "
                   "source, always a fresh result, every episode ends once",
                   World, actor_world, library_world) {
  dice random{4711};
  int episodes = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const link_fault_options faults{
        random.between(0, 0.4), random.between(0, 0.4), random.between(0, 0.4),
        from_seconds(random.between(0.001, 2.0))};
    episodes +=
        live<World>(seed, faults, 1 + static_cast<int>(seed % 3), std::nullopt)
            .remote_episodes;
  }
  CHECK(episodes > 500); // faults did not keep everybody local
}

TEST_CASE_TEMPLATE("whatever a link does: with two providers at once, with one "
                   "that stands by, and with those that decide once in a while",
                   World, actor_world, library_world) {
  dice random{1848};
  int episodes = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    auto of = with_two(seed % 2 == 0 ? 0ms : 20ms);
    if (seed % 3 == 0)
      of.provider_policy = [] { return std::make_unique<patient>(); };
    const link_fault_options faults{
        random.between(0, 0.3), random.between(0, 0.3), random.between(0, 0.3),
        from_seconds(random.between(0.001, 1.0))};
    episodes += live<World>(seed, faults, 3, std::nullopt, of).remote_episodes;
  }
  CHECK(episodes > 100);
}

TEST_CASE_TEMPLATE("whatever a link does to results of which some are lies or "
                   "useless: those are not used, and end their session",
                   World, actor_world, library_world) {
  dice random{1835};
  int implausible = 0, gaps = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const auto of = with_liars(
        seed % 3 != 0 ? conduct{} : with_two(seed % 2 == 0 ? 0ms : 20ms), seed);
    const link_fault_options faults{
        random.between(0, 0.3), random.between(0, 0.3), random.between(0, 0.3),
        from_seconds(random.between(0.001, 1.0))};
    const auto book = live<World>(seed, faults, 3, std::nullopt, of);
    implausible += book.reasons.contains(end_reason::implausible);
    gaps += book.reasons.contains(end_reason::qos_gap);
  }
  CHECK(implausible == 12);
  CHECK(gaps >= 10);
}

TEST_CASE_TEMPLATE("a vehicle tells whom it asks, and whom else it could ask",
                   World, actor_world, library_world) {
  int others = 0;
  conduct of;
  of.provider_policy = [&others] {
    return std::make_unique<attentive>(others);
  };
  live<World>(1, {}, 3, std::nullopt, of);
  CHECK(others > 30);
}

TEST_CASE_TEMPLATE("who stands by is not called while the other one answers in "
                   "time",
                   World, actor_world, library_world) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    CAPTURE(seed);
    World w{seed, {}, 2, "ideal", with_two(40ms)};
    w.run_and_check(200s);
    w.dismiss();
    CHECK(w.diary->made[trace_step::standby] > 0);
    CHECK(w.diary->made[trace_step::called] == 0);
  }
}

TEST_CASE_TEMPLATE("what is computed once for each input is offloaded like "
                   "what is computed in a rhythm",
                   World, actor_world, library_world) {
  SUBCASE("on a good link") {
    const auto book = live<World>(1, {}, 1, std::nullopt, per_input());
    CHECK(book.remote_episodes >= 6);
    CHECK(!book.reasons.contains(end_reason::no_data));
  }
  SUBCASE("on bad ones") {
    int episodes = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed)
      episodes += live<World>(seed, {0.1, 0.2, 0.2, 50ms}, 3, std::nullopt,
                              per_input(with_two(seed % 2 == 0 ? 0ms : 20ms)))
                      .remote_episodes;
    CHECK(episodes > 60);
  }
}

TEST_CASE_TEMPLATE("a vehicle whose own functions run along keeps every "
                   "promise, also when its provider crashes",
                   World, actor_world, library_world) {
  int episodes = 0;
  dice random{2077};
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    auto of = seed % 2 == 0 ? warm(with_two(20ms)) : warm(per_input());
    const auto crash = seed % 3 == 0
                           ? std::optional{from_seconds(random.between(5, 60))}
                           : std::nullopt;
    episodes +=
        live<World>(seed, {0.1, 0.2, 0.2, 50ms}, 2, crash, of).remote_episodes;
  }
  CHECK(episodes > 60);
}

TEST_CASE_TEMPLATE("whose scene is not safe under the response time of a "
                   "provider has its services at home a moment later",
                   World, actor_world, library_world) {
  int episodes = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    CAPTURE(seed);
    World w{seed, {0.1, 0.1, 0.1, 50ms}, 3, "paper_5g", within_its_scene()};
    for (int k = 0; k < 4000; ++k) {
      w.run_and_check(50ms);
      const auto tight_for_a_moment =
          tight_now_and_then::is_tight(w.now())
          && tight_now_and_then::is_tight(w.now() - 150ms);
      for (const auto& x : w.diary->services)
        CHECK((!x.remote || !tight_for_a_moment));
    }
    w.dismiss();
    w.diary->finish();
    for (const auto& text : w.diary->broken)
      FAIL_CHECK(text);
    episodes += w.book->remote_episodes;
  }
  CHECK(episodes > 60);
}

TEST_CASE("who stands by answers when the other one has died") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    CAPTURE(seed);
    library_world w{seed, {}, 2, "ideal", with_two(40ms)};
    w.run_and_check(50s);
    const auto before = w.diary->used_of[provider_id{2}];
    w.silence_provider();
    w.run_and_check(1s);
    CHECK(w.diary->made[trace_step::called] > 0);
    CHECK(w.diary->used_of[provider_id{2}] >= before + 30); // of 40
    w.dismiss();
  }
}

TEST_CASE_TEMPLATE("when the provider crashes, its vehicles go on locally at "
                   "once",
                   World, actor_world, library_world) {
  dice random{815};
  for (std::uint64_t seed = 1; seed <= 40; ++seed)
    live<World>(
        seed, {}, seed % 2 == 0 ? 1 : 2, from_seconds(random.between(5, 60)),
        seed % 2 == 0 ? conduct{} : with_two(seed % 4 < 2 ? 0ms : 20ms));
}

TEST_CASE("when a provider dies and nothing says so, its vehicle has a fresh "
          "result all the same, and runs nothing there soon after") {
  dice random{1912};
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    CAPTURE(seed);
    library_world w{
        seed, {}, 2, "paper_5g", with_two(seed % 2 == 0 ? 0ms : 20ms)};
    w.run_and_check(from_seconds(random.between(5, 60)));
    const auto dead = seed / 2 % 2; // also the one that stands by
    w.silence_provider(dead);
    const auto since = w.now();
    w.run_and_check(20s);
    for (const auto& [session, left] : w.book->left)
      CHECK((session.provider != provider_id{dead + 1}
             || left <= since + protocol::confirmation_timeout));
    w.dismiss();
    for (const auto& [session, left] : w.book->left)
      CHECK((session.provider != provider_id{dead + 1}
             || left <= since + protocol::confirmation_timeout));
    w.diary->finish();
    for (const auto& text : w.diary->broken)
      FAIL_CHECK(text);
  }
}

TEST_CASE("a provider that starts again is another one: its vehicle forgets "
          "which it was, and runs its services there") {
  dice random{1969};
  int again = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    library_world w{seed,
                    {random.between(0, 0.2), 0, 0, {}},
                    2,
                    "paper_5g",
                    with_two(seed % 2 == 0 ? 0ms : 20ms)};
    for (int starts = 0; starts < 3; ++starts) {
      w.run_and_check(from_seconds(random.between(5, 60)));
      w.silence_provider();
      w.run_and_check(from_seconds(random.between(0, 5)));
      w.restart_provider();
    }
    w.run_and_check(60s);
    w.dismiss();
    w.diary->finish();
    for (const auto& text : w.diary->broken)
      FAIL_CHECK(text);
    for (const auto& [session, times] : w.book->closed_by_requester) {
      CHECK(times == 1);
      again += session.provider > provider_id{100};
    }
  }
  CHECK(again > 100);
}

TEST_CASE_TEMPLATE("when a vehicle crashes, its provider closes what it ran "
                   "for it",
                   World, actor_world, library_world) {
  dice random{2020};
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    CAPTURE(seed);
    World w{seed, {}, 1};
    w.run_and_check(from_seconds(random.between(15, 50))); // in the area
    w.crash_vehicle();
    w.run_for(5s); // longer than the CAM check takes
    CHECK(w.book->closed_by_provider.size() >= 2);
    for (const auto& [session, times] : w.book->closed_by_provider)
      CHECK(times == 1);
    w.dismiss();
    w.diary->finish();
    for (const auto& text : w.diary->broken)
      FAIL_CHECK(text);
  }
}

TEST_CASE_TEMPLATE("a lost message costs seconds of offloading, not a passage",
                   World, actor_world, library_world) {
  // What the provider runs and the requester does not know of blocks offers.
  duration blocked{}, longest{};
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const link_fault_options faults{0.1, 0, 0, {}};
    World w{seed, faults, 1};
    w.run_for(200s);
    w.dismiss_vehicle();
    for (const auto& [session, lasted] : w.book->provider_side)
      if (!w.book->closed_by_requester.contains(session)) {
        blocked += lasted;
        longest = std::max(longest, lasted);
      }
  }
  CHECK(blocked > 0ns); // responses were lost
  CHECK(longest <= protocol::start_timeout + 1ms);
}

TEST_CASE("actors and library leave the same ledger of the same seed") {
  for (const auto* channel : {"paper_5g", "ideal"}) {
    CAPTURE(channel);
    dice random{99};
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      CAPTURE(seed);
      const link_fault_options faults{
          random.between(0, 0.3), random.between(0, 0.3),
          random.between(0, 0.3), from_seconds(random.between(0.001, 1.0))};
      const auto providers = 1 + static_cast<int>(seed % 3);
      actor_world actors{seed, faults, providers, channel};
      library_world library{seed, faults, providers, channel};
      actors.run_for(200s);
      library.run_for(200s);
      CHECK(actors.book->remote_episodes > 0);
      CHECK(*actors.book == *library.book);
    }
  }
}
