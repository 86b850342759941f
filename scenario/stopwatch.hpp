// How long something takes on the wall's clock; only for people to read.
#pragma once

#include <chrono>

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

} // namespace sofof
