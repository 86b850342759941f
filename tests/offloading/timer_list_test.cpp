// Tests of the numbers of timers.
#include "offloading/timer_list.hpp"

#include <doctest/doctest.h>

using sofof::offloading::timer_list;

TEST_CASE("a timer is taken once, in any order") {
  timer_list<char> timers;
  const auto a = timers.add('a'), b = timers.add('b'), c = timers.add('c');
  CHECK(timers.claim(b) == 'b');
  CHECK(timers.claim(a) == 'a');
  CHECK(!timers.claim(b));
  CHECK(timers.claim(c) == 'c');
  CHECK(timers.size() == 0);
}

TEST_CASE("no two timers have the same number") {
  timer_list<char> timers;
  const auto a = timers.add('a');
  timers.claim(a);
  const auto b = timers.add('b');
  CHECK(a != b);
  CHECK(!timers.claim(a));
  CHECK(timers.claim(b) == 'b');
}
