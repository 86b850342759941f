// Sleeping, and being woken late.
#include "scenario/stall_watch.hpp"

#include <chrono>

namespace sofof::scenario {

namespace {

using namespace std::chrono_literals;

constexpr auto nap = 10ms;

} // namespace

stall_watch::stall_watch()
    : thread_{[this](const std::stop_token& end) { look(end); }} {}

recording::standstill stall_watch::so_far() const {
  const std::lock_guard lock{mutex_};
  return seen_;
}

void stall_watch::look(const std::stop_token& end) {
  using clock = std::chrono::steady_clock;
  const auto since = [](clock::time_point then) {
    return std::chrono::duration_cast<duration>(clock::now() - then);
  };
  const auto start = clock::now();
  while (!end.stop_requested()) {
    const auto due = clock::now() + nap;
    std::this_thread::sleep_until(due);
    const auto late = since(due);
    const std::lock_guard lock{mutex_};
    seen_.woken_late(late, since(start));
  }
}

} // namespace sofof::scenario
