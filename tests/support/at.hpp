// Times since the start.
#pragma once

#include "base/time.hpp"

namespace sofof::test {

constexpr time_point at(duration since_start) {
  return time_point{since_start};
}

} // namespace sofof::test
