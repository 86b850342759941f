// The clocks of computing time. They show what a computer had to do, and decide
// nothing: no actor acts on them.
#pragma once

#include "base/time.hpp"

#include <chrono>
#include <ctime>

namespace sofof::actors {

namespace detail {

inline duration read_cpu_clock(clockid_t which) {
  std::timespec t{};
  clock_gettime(which, &t);
  return std::chrono::seconds{t.tv_sec} + std::chrono::nanoseconds{t.tv_nsec};
}

} // namespace detail

/// @returns for how long this thread has computed.
inline duration thread_cpu_time() {
  return detail::read_cpu_clock(CLOCK_THREAD_CPUTIME_ID);
}

/// @returns for how long all threads of this process have computed.
inline duration process_cpu_time() {
  return detail::read_cpu_clock(CLOCK_PROCESS_CPUTIME_ID);
}

} // namespace sofof::actors
