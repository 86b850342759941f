// What sensors and strangers may give instead of a number.
#pragma once

#include <limits>

namespace sofof::test {

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

} // namespace sofof::test
