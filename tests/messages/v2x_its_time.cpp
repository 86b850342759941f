// Tests of ETSI's time: leap seconds and wrap-around.
#include "messages/etsi/its_time.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cstdlib>

using namespace std::chrono_literals;

namespace sofof::messages::etsi {

TEST_CASE("the ITS clock began with 2004 and counts leap seconds") {
  CHECK(to_timestamp_its(its_epoch_unix_ms) == 0);
  // As Wireshark prints it: 2026-03-07T20:26:35.123Z.
  CHECK(to_timestamp_its(1'772'915'195'123) == 700'000'000'123);
  CHECK(to_unix_ms(700'000'000'123) == 1'772'915'195'123);
  // 2016-12-31T23:59:59.999Z, a second of leap, and the New Year.
  CHECK(to_timestamp_its(1'483'228'800'000)
            - to_timestamp_its(1'483'228'799'999)
        == 1001);
}

TEST_CASE("every moment outside leap seconds comes back") {
  for (const auto leap : leap_seconds_unix_ms)
    for (auto unix_ms = leap - 3000; unix_ms < leap + 3000; ++unix_ms)
      REQUIRE(to_unix_ms(to_timestamp_its(unix_ms)) == unix_ms);
}

TEST_CASE("a run in virtual time begins with 2026") {
  constexpr its_clock clock;
  // 22 years with six days of leap, and five seconds.
  constexpr auto days = 22 * 365 + 6;
  CHECK(clock.timestamp(time_point{})
        == std::int64_t{days} * 86'400'000 + 5000);
  CHECK(clock.timestamp(time_point{1999999ns})
        == clock.timestamp(time_point{}) + 1);
  CHECK(clock.timestamp(time_point{-1ns}) == clock.timestamp(time_point{}) - 1);
  const time_point later{123456ms};
  CHECK(clock.time(clock.timestamp(later)) == later);
  CHECK(its_clock{its_epoch_unix_ms}.timestamp(time_point{5ms}) == 5);
}

TEST_CASE("sixteen bits are enough for half a minute back and ahead") {
  test::dice d{7};
  for (int i = 0; i < 100000; ++i) {
    const auto now = static_cast<its_ms>(d.between(6.9e11, 7.1e11));
    const auto age = static_cast<int>(d.between(-32767, 32768));
    REQUIRE(age_ms(to_delta_time(now - age), now) == age);
    REQUIRE(unwrap(to_delta_time(now - age), now) == now - age);
  }
}

TEST_CASE("a message sent before the wrap and read behind it is not old") {
  const its_ms wrap = 10'000'000 * std::int64_t{65536};
  CHECK(to_delta_time(wrap - 1) == 65535);
  CHECK(to_delta_time(wrap) == 0);
  CHECK(age_ms(65535, wrap + 20) == 21);
  CHECK(unwrap(65535, wrap + 20) == wrap - 1);
  // Of a sender whose clock is ahead.
  CHECK(age_ms(5, wrap - 3) == -8);
  CHECK(unwrap(5, wrap - 3) == wrap + 5);
}

} // namespace sofof::messages::etsi
