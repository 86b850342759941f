// A machine that stands still is noticed.
#include "scenario/stall_watch.hpp"

#include <doctest/doctest.h>

#include <thread>

using namespace sofof;
using namespace std::chrono_literals;

TEST_CASE("to be woken late by more than 20 ms is a standstill") {
  recording::standstill seen;
  seen.woken_late(-1ms, 1s);
  seen.woken_late(20ms, 2s);
  CHECK(seen.together == 0ms);
  seen.woken_late(21ms, 3s);
  seen.woken_late(400ms, 4s);
  seen.woken_late(30ms, 5s);
  CHECK(seen.together == 451ms);
  CHECK(seen.longest == 400ms);
  CHECK(seen.longest_at == 4s);
}

// How late a thread is woken is the machine's affair; what is seen is whole.
TEST_CASE("what a watch has seen is no more than the time that has passed, and "
          "the longest of it no more than all") {
  const auto began = std::chrono::steady_clock::now();
  const scenario::stall_watch watch;
  std::this_thread::sleep_for(50ms);
  const auto seen = watch.so_far();
  const auto passed = std::chrono::steady_clock::now() - began;
  CHECK(seen.longest <= seen.together);
  CHECK(seen.together <= passed);
}
