// Tests of the limits that results must keep.
#include "offloading/qos_monitor.hpp"

#include "tests/support/at.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace std::chrono_literals;
using test::at;

TEST_CASE("a result exactly at the limit is in time, a nanosecond later it is "
          "not") {
  CHECK(offloading::in_time(at(1s), at(1050ms), 50ms));
  CHECK(!offloading::in_time(at(1s), at(1050ms + 1ns), 50ms));
  CHECK(offloading::in_time(at(1s), at(1s), 50ms));
}

TEST_CASE("a result from the future is not in time") {
  CHECK(!offloading::in_time(at(1s + 1ns), at(1s), 50ms));
}

TEST_CASE("a gap exactly at the limit is not too long, a nanosecond more is") {
  offloading::gap_monitor gaps{100ms};
  gaps.arrived(at(1s));
  CHECK(!gaps.too_long(at(1100ms)));
  CHECK(gaps.too_long(at(1100ms + 1ns)));
  CHECK(gaps.deadline() == at(1100ms + 1ns));
}

TEST_CASE("every arrival moves the deadline") {
  offloading::gap_monitor gaps{100ms};
  gaps.arrived(at(1s));
  gaps.arrived(at(1090ms));
  CHECK(!gaps.too_long(at(1190ms)));
  CHECK(gaps.too_long(at(1191ms)));
}
