// Durations as text.
#include "base/options/units.hpp"

#include "base/random.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <limits>

using namespace sofof;
using namespace std::chrono_literals;

TEST_CASE("a duration is a decimal number and its unit") {
  CHECK(parse_duration("50ms") == 50ms);
  CHECK(parse_duration("1.5s") == 1500ms);
  CHECK(parse_duration("30min") == 30min);
  CHECK(parse_duration("2h") == 2h);
  CHECK(parse_duration("0.25h") == 15min);
  CHECK(parse_duration("7us") == 7us);
  CHECK(parse_duration("3ns") == 3ns);
  CHECK(parse_duration("0s") == 0s);
  CHECK(parse_duration("007.500s") == 7500ms);
  CHECK(parse_duration("-5ms") == -5ms);
}

TEST_CASE("what is not a number with a unit is no duration") {
  for (const auto text :
       {"", "5", "ms", "-", "5 ms", " 5ms", "5ms ", "5m", "5MS", ".5s", "5.s",
        "1e3ms", "+5ms", "--5ms", "0x5ms", "1,5s", "5.5.5s", "five s"}) {
    CAPTURE(text);
    CHECK_FALSE(parse_duration(text));
  }
}

TEST_CASE("a duration that does not fit into whole nanoseconds is refused") {
  CHECK(parse_duration("1.000us") == 1us);
  CHECK_FALSE(parse_duration("1.5ns"));
  CHECK_FALSE(parse_duration("1.0000000001s"));
  CHECK(parse_duration("1.0000000010s") == 1s + 1ns);
  CHECK(parse_duration("9223372036854775807ns") == duration::max());
  CHECK_FALSE(parse_duration("9223372036854775808ns"));
  CHECK_FALSE(parse_duration("9223372036.854775808s"));
  CHECK_FALSE(parse_duration("2562048h"));
  CHECK_FALSE(parse_duration("99999999999999999999999h"));
}

TEST_CASE("a duration is printed with the largest unit that fits") {
  CHECK(print_duration(0ns) == "0s");
  CHECK(print_duration(50ms) == "50ms");
  CHECK(print_duration(1500ms) == "1.5s");
  CHECK(print_duration(61s) == "61s");
  CHECK(print_duration(90s) == "90s");
  CHECK(print_duration(90min) == "90min");
  CHECK(print_duration(2h) == "2h");
  CHECK(print_duration(1s + 1ns) == "1.000000001s");
  CHECK(print_duration(12090us) == "12.09ms");
  CHECK(print_duration(-1500us) == "-1.5ms");
}

TEST_CASE("a printed duration reads back as exactly the same") {
  const random_stream draws{1, "durations"};
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    const auto shift = draws.bits(i, 1) % 64;
    const auto d = duration{static_cast<std::int64_t>(draws.bits(i) >> shift)};
    CAPTURE(d.count());
    REQUIRE(parse_duration(print_duration(d)) == d);
  }
  for (const duration d :
       {duration::max(), -duration::max(), -1ns, duration{3'599'999ms}})
    CHECK(parse_duration(print_duration(d)) == d);
}

TEST_CASE("even the shortest duration of all can be printed") {
  CHECK(print_duration(duration::min()) == "-9223372036.854775808s");
}
