// How long something takes on the wall's clock; only for people to read.
#pragma once

#include <chrono>
#include <ctime>

namespace sofof {

class stopwatch {
public:
  double elapsed_s() const {
    return std::chrono::duration<double>(clock::now() - start_).count();
  }

private:
  using clock = std::chrono::steady_clock;
  clock::time_point start_ = clock::now();
};

/// The same on this thread's own clock: what others do on the machine does not
/// count.
class cpu_stopwatch {
public:
  double elapsed_us() const { return now_us() - start_us_; }

private:
  static double now_us() {
    std::timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e6
           + static_cast<double>(now.tv_nsec) * 1e-3;
  }

  double start_us_ = now_us();
};

} // namespace sofof
