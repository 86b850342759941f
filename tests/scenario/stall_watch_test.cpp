// A machine that stands still is noticed.
#include "scenario/stall_watch.hpp"

#include <doctest/doctest.h>

#include <thread>

using namespace sofof;
using namespace std::chrono_literals;

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
  CHECK((seen.longest == 0ms || seen.longest > 20ms));
}
