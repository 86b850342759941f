// Who sends in the tests of V2X messages, and from when on.
#pragma once

#include "base/time.hpp"
#include "world/vehicle/vehicle.hpp"

#include <numbers>

namespace sofof::test {

inline constexpr double degree = std::numbers::pi / 180;
inline constexpr time_point start{std::chrono::seconds{100}};
inline const world::vehicle_params car;

} // namespace sofof::test
