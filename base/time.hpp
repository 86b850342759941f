// Time: nanoseconds since the run's clock began.
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>

namespace sofof {

using duration = std::chrono::nanoseconds;

/// The clock of a run, virtual or wall. It only names the type of its time
/// points; to read it, ask an actor (actors/runtime/time.hpp).
struct world_clock {
  using duration = sofof::duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<world_clock, duration>;
  static constexpr bool is_steady = true;
};

using time_point = world_clock::time_point;

/// Times of strangers lie within this, so that differences never overflow;
/// 36 years.
inline constexpr duration longest_time{std::int64_t{1} << 60};

/// @returns whether a time from a stranger can be reckoned with.
constexpr bool is_plausible(time_point t) {
  return t.time_since_epoch() <= longest_time
         && t.time_since_epoch() >= -longest_time;
}

/// @returns `d` in seconds.
constexpr double to_seconds(duration d) {
  return static_cast<double>(d.count()) * 1e-9;
}

/// @returns the time point in seconds since the clock began.
constexpr double to_seconds(time_point t) {
  return to_seconds(t.time_since_epoch());
}

/// @returns `d` in milliseconds.
constexpr double to_milliseconds(duration d) {
  return static_cast<double>(d.count()) * 1e-6;
}

/// @param seconds  |seconds| < 9.2e9.
/// @returns the nearest whole number of nanoseconds.
inline duration from_seconds(double seconds) {
  // As std::llround does it, without a call: the number below a half lifts
  // what is to be rounded up over the next whole number, and nothing else.
  constexpr double almost_half = 0x1.fffffffffffffp-2;
  const auto ns = seconds * 1e9;
  return duration{
      static_cast<duration::rep>(ns + std::copysign(almost_half, ns))};
}

} // namespace sofof
