// Tests of how far another host's clock is ahead: random exchanges over links
// whose delays and clocks are known.
#include "network/flow/clock_estimate.hpp"

#include "channel/delay_distribution.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/at.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

using namespace sofof;
using namespace sofof::channel;
using namespace sofof::network;
using namespace std::chrono_literals;
using test::at;

namespace {

constexpr auto period = 50ms; // 20 Hz
constexpr auto settled = 5s;

/// Another clock: ahead by a shift that grows with the drift and makes a step.
struct other_clock {
  duration shift{0};
  double drift_ppm = 0;
  duration step{0};
  duration step_at = duration::max();

  duration ahead(duration now) const {
    return shift + from_seconds(to_seconds(now) * drift_ppm * 1e-6)
           + (now >= step_at ? step : 0ns);
  }
  time_point shows(duration now) const { return at(now + ahead(now)); }
};

/// How messages travel, each way by itself.
struct message_link {
  std::string_view name;
  delay_distribution there;
  delay_distribution back;
  duration floor = 5ms;        // added to both
  duration longest_hold = 2ms; // until the other side answers
  double loss = 0.01;
  double copies = 0.01;
};

message_link even(std::string_view name, delay_distribution law,
                  duration floor = 5ms) {
  return {name, law, law, floor};
}

const auto lognormal = even("5 ms + lognormal",
                            delay_distribution::lognormal(0ms, 3740us, 2800us));
const auto jitter =
    even("5 ms + 30 ms jitter", delay_distribution::uniform(0ms, 30ms));
const auto bare_jitter =
    even("30 ms jitter", delay_distribution::uniform(0ms, 30ms), 0ms);
const auto wire =
    even("1 ms + exponential", delay_distribution::exponential(1ms), 1ms);
const auto loopback =
    even("loopback", delay_distribution::exponential(20us), 10us);

/// Exchanges from `from` to `to` as they come in: late ones after others,
/// copies, and gaps where any message was lost.
std::vector<clock_exchange> exchanges(const other_clock& theirs,
                                      const message_link& way,
                                      std::uint64_t seed, duration from,
                                      duration to) {
  const random_stream random{seed, "exchanges"};
  std::vector<clock_exchange> all;
  std::uint64_t n = 0;
  for (auto asked = from; asked < to; asked += period, ++n) {
    if (random.uniform(n, 0) < way.loss)
      continue;
    const auto heard =
        asked + way.floor + from_seconds(way.there.draw_s(random, n, 1));
    const auto answered =
        heard
        + from_seconds(random.uniform(n, 2) * to_seconds(way.longest_hold));
    const auto received =
        answered + way.floor + from_seconds(way.back.draw_s(random, n, 3));
    all.push_back(
        {at(asked), theirs.shows(heard), theirs.shows(answered), at(received)});
    if (random.uniform(n, 4) < way.copies) {
      all.push_back(all.back());
      all.back().received += from_seconds(random.uniform(n, 5) * 0.1);
    }
  }
  std::ranges::sort(all, {}, &clock_exchange::received);
  return all;
}

struct miss {
  duration error;
  duration doubt;
};

miss miss_at(const clock_estimate& estimate, const other_clock& theirs,
             duration now) {
  const auto offset = estimate.at(at(now));
  REQUIRE(offset);
  return {std::chrono::abs(offset->ahead - theirs.ahead(now)), offset->doubt};
}

constexpr clock_exchange exchange(duration asked, duration heard,
                                  duration answered, duration received) {
  return {at(asked), at(heard), at(answered), at(received)};
}

} // namespace

// -- One by one --------------------------------------------------------------

TEST_CASE("nothing is known before the first exchange") {
  const clock_estimate estimate;
  CHECK(!estimate.at(at(0s)));
  CHECK(estimate.drift_ppm() == 0);
  CHECK(estimate.steps() == 0);
}

TEST_CASE("one exchange over an even link tells the offset, in doubt by half "
          "the time on the way") {
  clock_estimate estimate;
  estimate.add(exchange(10s, 510s + 8ms, 510s + 12ms, 10s + 20ms));
  const auto offset = estimate.at(at(10s + 20ms));
  REQUIRE(offset);
  CHECK(offset->ahead == 500s);
  CHECK(offset->doubt >= 8ms);
  CHECK(offset->doubt < 8ms + 10us);
}

TEST_CASE("the quickest message of each way counts, whichever exchange it was "
          "of") {
  clock_estimate estimate;
  estimate.add(exchange(0ms, 2ms, 2ms, 42ms));
  estimate.add(exchange(50ms, 90ms, 90ms, 92ms));
  const auto offset = estimate.at(at(92ms));
  REQUIRE(offset);
  CHECK(std::chrono::abs(offset->ahead) < 20us);
  CHECK(offset->doubt < 2ms + 40us);
}

TEST_CASE("doubt grows with age by what clocks may drift apart") {
  clock_estimate estimate;
  estimate.add(exchange(0ms, 5ms, 5ms, 10ms));
  const auto doubt = [&](duration now) { return estimate.at(at(now))->doubt; };
  CHECK(doubt(10s + 10ms) - doubt(10ms) == 2ms);
  CHECK(doubt(1h) - doubt(10ms) > 700ms);
}

TEST_CASE("a copy teaches nothing new") {
  clock_estimate once;
  clock_estimate twice;
  for (const auto& e : exchanges({300ms, 50}, lognormal, 1, 0s, 10s)) {
    once.add(e);
    twice.add(e);
    twice.add(e);
    CHECK(once.at(e.received)->ahead == twice.at(e.received)->ahead);
    CHECK(once.at(e.received)->doubt == twice.at(e.received)->doubt);
  }
}

TEST_CASE("an exchange that comes late counts as if it had come in time") {
  clock_estimate estimate;
  estimate.add(exchange(1s, 1s + 30ms, 1s + 30ms, 1s + 60ms));
  estimate.add(exchange(2s, 2s + 30ms, 2s + 30ms, 2s + 60ms));
  estimate.add(exchange(500ms, 505ms, 505ms, 510ms));
  estimate.add(exchange(1500ms, 1504ms, 1504ms, 1508ms));
  const auto offset = estimate.at(at(2s + 60ms));
  REQUIRE(offset);
  CHECK(std::chrono::abs(offset->ahead) < 1us);
  CHECK(offset->doubt < 4ms + 150us);
}

// -- Random links and clocks -------------------------------------------------

TEST_CASE("after 5 s the offset is right within 2 ms, and the truth always "
          "lies within the doubt") {
  for (const auto& way : {lognormal, jitter, bare_jitter, wire, loopback}) {
    CAPTURE(way.name);
    duration largest_error{0};
    duration largest_doubt{0};
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
      CAPTURE(seed);
      const random_stream random{seed, "clock"};
      const other_clock theirs{seed % 2 ? 500ms : -500ms,
                               seed < 150 ? (seed % 4 < 2 ? 50 : -50)
                                          : random.uniform(-50, 50, 0)};
      clock_estimate estimate;
      for (const auto& e : exchanges(theirs, way, seed, 0s, 30s)) {
        estimate.add(e);
        const auto now = e.received.time_since_epoch();
        const auto [error, doubt] = miss_at(estimate, theirs, now);
        REQUIRE(error <= doubt);
        if (now < settled)
          continue;
        REQUIRE(error <= 2ms);
        largest_error = std::max(largest_error, error);
        largest_doubt = std::max(largest_doubt, doubt);
      }
      CHECK(estimate.steps() == 0);
    }
    MESSAGE(way.name, ": error at most ", to_milliseconds(largest_error),
            " ms after 5 s, doubt at most ", to_milliseconds(largest_doubt),
            " ms");
  }
}

TEST_CASE(
    "the truth lies within the doubt, however uneven the ways and however "
    "far the clocks drift") {
  const std::array laws{delay_distribution{},
                        delay_distribution::uniform(0ms, 30ms),
                        delay_distribution::exponential(10ms),
                        delay_distribution::lognormal(20ms, 40ms, 60ms),
                        delay_distribution::lognormal(0ms, 4ms, 3ms)};
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    CAPTURE(seed);
    const random_stream random{seed, "uneven"};
    const auto law = [&](std::uint32_t lane) {
      return laws[random.bits(0, lane) % laws.size()];
    };
    const message_link way{"uneven",
                           law(1),
                           law(2),
                           from_seconds(random.uniform(0, 0.02, 0, 3)),
                           from_seconds(random.uniform(0, 0.1, 0, 4)),
                           random.uniform(0, 0.5, 0, 5),
                           random.uniform(0, 0.5, 0, 6)};
    const other_clock theirs{from_seconds(random.uniform(-1e6, 1e6, 0, 7)),
                             random.uniform(-200, 200, 0, 8)};
    clock_estimate estimate;
    auto all = exchanges(theirs, way, seed, 1h, 1h + 100s);
    all.pop_back();
    duration now{0};
    for (const auto& e : all) {
      estimate.add(e);
      now = e.received.time_since_epoch();
      for (const duration later : {0ms, 40ms, 700ms}) {
        const auto [error, doubt] = miss_at(estimate, theirs, now + later);
        REQUIRE(error <= doubt);
      }
    }
    CHECK(estimate.steps() == 0);
    for (const duration later : {1s, 30s, 3600s}) {
      const auto [error, doubt] = miss_at(estimate, theirs, now + later);
      CHECK(error <= doubt);
    }
  }
}

TEST_CASE("the drift is found, and followed through a silence of 30 s") {
  for (const auto& way : {lognormal, jitter, wire}) {
    CAPTURE(way.name);
    double worst_drift_ppm = 0;
    duration worst_after_silence{0};
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      CAPTURE(seed);
      const other_clock theirs{500ms, seed % 2 ? 50.0 : -50.0};
      clock_estimate estimate;
      for (const auto& e : exchanges(theirs, way, seed, 0s, 70s))
        estimate.add(e);
      const auto wrong_ppm = std::abs(estimate.drift_ppm() - theirs.drift_ppm);
      worst_drift_ppm = std::max(worst_drift_ppm, wrong_ppm);
      worst_after_silence =
          std::max(worst_after_silence, miss_at(estimate, theirs, 100s).error);
    }
    CHECK(worst_drift_ppm < 30);
    CHECK(worst_after_silence < 2ms);
    MESSAGE(way.name, ": drift of 50 ppm wrong by at most ", worst_drift_ppm,
            " ppm after 70 s; error after 30 s of silence at most ",
            to_milliseconds(worst_after_silence), " ms");
  }
}

TEST_CASE("over an hour the estimate neither loses the clock nor asks for "
          "memory") {
  const other_clock theirs{-500ms, 50};
  const auto all = exchanges(theirs, jitter, 1, 0s, 1h);
  clock_estimate estimate;
  duration largest_error{0};
  const auto before = test::allocations;
  for (const auto& e : all) {
    estimate.add(e);
    const auto now = e.received.time_since_epoch();
    const auto error =
        std::chrono::abs(estimate.at(e.received)->ahead - theirs.ahead(now));
    if (now >= settled)
      largest_error = std::max(largest_error, error);
  }
  CHECK(test::allocations == before);
  CHECK(largest_error <= 2ms);
  CHECK(estimate.steps() == 0);
}

TEST_CASE("a way that becomes longer misleads by half of it at most, and is no "
          "step") {
  const other_clock theirs{500ms, 50};
  clock_estimate estimate;
  for (const auto& e : exchanges(theirs, lognormal, 1, 0s, 20s))
    estimate.add(e);
  auto longer = lognormal;
  longer.there = delay_distribution::lognormal(10ms, 3740us, 2800us);
  for (const auto& e : exchanges(theirs, longer, 2, 20s, 60s)) {
    estimate.add(e);
    const auto [error, doubt] =
        miss_at(estimate, theirs, e.received.time_since_epoch());
    CHECK(error <= doubt);
    CHECK(error <= 7ms);
  }
  CHECK(estimate.steps() == 0);
}

// -- Steps -------------------------------------------------------------------

TEST_CASE("a step of the other clock is followed within 2 s") {
  for (const auto& way : {lognormal, jitter, bare_jitter, wire}) {
    CAPTURE(way.name);
    duration largest_error{0};
    for (const duration step : {300ms, -300ms, 100ms, -100ms, -3600'000ms})
      for (std::uint64_t seed = 0; seed < 50; ++seed) {
        CAPTURE(seed);
        const other_clock theirs{500ms, 50, step, 20s};
        clock_estimate estimate;
        for (const auto& e : exchanges(theirs, way, seed, 0s, 40s)) {
          estimate.add(e);
          const auto now = e.received.time_since_epoch();
          if (now >= 20s && now < 21s)
            continue;
          const auto [error, doubt] = miss_at(estimate, theirs, now);
          REQUIRE(error <= doubt);
          if (now >= 22s)
            largest_error = std::max(largest_error, error);
          if (now >= 25s)
            REQUIRE(error <= 2ms);
        }
        CHECK(estimate.steps() == 1);
      }
    CHECK(largest_error <= 5ms);
    MESSAGE(way.name, ": error at most ", to_milliseconds(largest_error),
            " ms from 2 s after a step on");
  }
}

TEST_CASE("a step too small to tell from delays is forgotten after 9 s") {
  for (const duration step : {2ms, -2ms, 5ms, -5ms, 8ms, -8ms, 12ms, -12ms})
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      CAPTURE(seed);
      const other_clock theirs{500ms, 50, step, 20s};
      clock_estimate estimate;
      for (const auto& e : exchanges(theirs, lognormal, seed, 0s, 40s)) {
        estimate.add(e);
        const auto now = e.received.time_since_epoch();
        const auto [error, doubt] = miss_at(estimate, theirs, now);
        if (now >= settled)
          CHECK(error <= std::chrono::abs(step) + 2ms);
        if (now >= 29s + 100ms) {
          CHECK(error <= doubt);
          CHECK(error <= 4ms);
        }
      }
    }
}

TEST_CASE("a step of our own clock is followed, too") {
  for (const duration back : {10s, 1000s, -1000s}) {
    const other_clock before{500ms, 50};
    const other_clock after{500ms + back, 50};
    clock_estimate estimate;
    for (const auto& e : exchanges(before, lognormal, 1, 2000s, 2100s))
      estimate.add(e);
    for (const auto& e :
         exchanges(after, lognormal, 2, 2100s - back, 2106s - back))
      estimate.add(e);
    CHECK(miss_at(estimate, after, 2106s - back).error <= 2ms);
    CHECK(estimate.steps() == 1);
  }
}

TEST_CASE("single contradictions are no step and change nothing") {
  const other_clock theirs{500ms, 50};
  clock_estimate estimate;
  clock_estimate untroubled;
  std::uint64_t n = 0;
  for (const auto& e : exchanges(theirs, lognormal, 1, 0s, 60s)) {
    estimate.add(e);
    untroubled.add(e);
    if (++n % 20 == 0) {
      auto lie = e;
      lie.heard += 5s;
      lie.answered += 5s;
      estimate.add(lie);
    }
    CHECK(estimate.at(e.received)->ahead == untroubled.at(e.received)->ahead);
  }
  CHECK(estimate.steps() == 0);
}

// -- Nonsense ----------------------------------------------------------------

TEST_CASE("impossible stamps are ignored") {
  const std::array nonsense{
      exchange(1s, 1s, 1s, 999ms),                // received before asked
      exchange(1s, 1s, 999ms, 2s),                // answered before heard
      exchange(1s, 1s, 2s, 1s + 100ms),           // held longer than away
      exchange(1s, 2s, 2s, 12s),                  // away for too long
      exchange(-100'000h, 1s, 1s, 2s),            // likewise
      exchange(1s, 1s, 1s, 100'000h),             // from the far future
      exchange(duration::min(), 1s, 1s, 2s),      // strangers in time
      exchange(1s, duration::min(), 1s, 2s),      //
      exchange(1s, 1s, duration::max(), 2s),      //
      exchange(1s, 1s, 1s, duration::max()),      //
      exchange(duration::max(), duration::max(),  //
               duration::max(), duration::max()), //
      exchange(duration::min(), duration::min(),  //
               duration::min(), duration::min())};
  clock_estimate estimate;
  for (const auto& e : nonsense)
    estimate.add(e);
  CHECK(!estimate.at(at(1s)));
  const auto good = exchange(20s, 20s + 5ms, 20s + 5ms, 20s + 10ms);
  estimate.add(good);
  for (int k = 0; k < 10; ++k)
    for (const auto& e : nonsense)
      estimate.add(e);
  CHECK(estimate.steps() == 0);
  CHECK(estimate.at(good.received)->ahead == 0s);
}

TEST_CASE("nothing is known of times that cannot be reckoned with") {
  clock_estimate estimate;
  estimate.add(exchange(0s, 0s, 0s, 0s));
  CHECK(!estimate.at(time_point::max()));
  CHECK(!estimate.at(time_point::min()));
  CHECK(estimate.at(at(longest_time)));
  CHECK(estimate.at(at(-longest_time)));
}

TEST_CASE("whatever a peer claims, the honest exchanges after it win") {
  // Stamps from all over time: sums and differences must not overflow, which
  // the sanitizers watch.
  const std::array<std::int64_t, 9> corners{
      std::numeric_limits<std::int64_t>::min(),
      -longest_time.count() - 1,
      -longest_time.count(),
      -1,
      0,
      1,
      longest_time.count(),
      longest_time.count() + 1,
      std::numeric_limits<std::int64_t>::max()};
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    CAPTURE(seed);
    const random_stream random{seed, "lies"};
    clock_estimate estimate;
    for (std::uint64_t n = 0; n < 400; ++n) {
      const auto stamp = [&](std::uint32_t lane) {
        const auto kind = random.bits(n, lane) % 4;
        if (kind == 0)
          return at(duration{corners[random.bits(n, lane + 4) % 9]});
        const auto shift = kind == 1 ? 62 : kind == 2 ? 30 : 3;
        return at(duration{static_cast<std::int64_t>(random.bits(n, lane + 4)
                                                     >> (64 - shift))});
      };
      clock_exchange e{stamp(0), stamp(1), stamp(2), stamp(3)};
      if (seed % 3 > 0) // what is possible gets further
        e.received = e.asked < at(longest_time) ? e.asked + 10ms : e.asked;
      if (seed % 3 > 1)
        e.answered = e.heard;
      estimate.add(e);
      const auto offset = estimate.at(e.received);
      if (offset)
        CHECK(offset->doubt >= 0s);
      estimate.at(e.asked);
      estimate.at(e.heard);
    }
    const other_clock theirs{-500ms, -50};
    for (const auto& e : exchanges(theirs, lognormal, seed, 100s, 110s))
      estimate.add(e);
    const auto [error, doubt] = miss_at(estimate, theirs, 110s);
    CHECK(error <= 2ms);
    CHECK(error <= doubt);
  }
}
