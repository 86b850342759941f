// Time as ETSI messages count it.
#pragma once

#include "base/time.hpp"

#include <array>
#include <chrono>
#include <cstdint>

namespace sofof::messages::etsi {

/// Milliseconds since 2004-01-01T00:00:00Z, leap seconds included
/// (TimestampIts of TS 102 894-2, 0..4398046511103).
using its_ms = std::int64_t;

/// Unix time of 2004-01-01T00:00:00Z, ms.
inline constexpr std::int64_t its_epoch_unix_ms = 1'072'915'200'000;

/// Unix times, ms, from which on there was one more leap second since 2004
/// (IERS Bulletin C).
inline constexpr std::array<std::int64_t, 5> leap_seconds_unix_ms{
    1'136'073'600'000, // 2006-01-01
    1'230'768'000'000, // 2009-01-01
    1'341'100'800'000, // 2012-07-01
    1'435'708'800'000, // 2015-07-01
    1'483'228'800'000, // 2017-01-01
};

constexpr its_ms to_timestamp_its(std::int64_t unix_ms) {
  auto its = unix_ms - its_epoch_unix_ms;
  for (const auto leap : leap_seconds_unix_ms)
    its += unix_ms >= leap ? 1000 : 0;
  return its;
}

/// @returns Unix time, ms; of a leap second the second after it.
constexpr std::int64_t to_unix_ms(its_ms its) {
  auto unix_ms = its + its_epoch_unix_ms;
  for (const auto leap : leap_seconds_unix_ms)
    unix_ms -= unix_ms > leap ? 1000 : 0;
  return unix_ms;
}

/// Where runs in virtual time begin: 2026-01-01T00:00:00Z.
inline constexpr std::int64_t virtual_epoch_unix_ms = 1'767'225'600'000;

/// Relates the run's clock to the time of day.
class its_clock {
public:
  /// @param epoch_unix_ms  When the run's clock stood at 0, Unix ms.
  constexpr explicit its_clock(
      std::int64_t epoch_unix_ms = virtual_epoch_unix_ms)
      : epoch_unix_ms_{epoch_unix_ms} {}

  /// @returns the last whole millisecond at or before `t`.
  constexpr its_ms timestamp(time_point t) const {
    const auto ms = std::chrono::floor<std::chrono::milliseconds>(t);
    return to_timestamp_its(epoch_unix_ms_ + ms.time_since_epoch().count());
  }

  /// @param its  Of this millennium.
  constexpr time_point time(its_ms its) const {
    return time_point{
        std::chrono::milliseconds{to_unix_ms(its) - epoch_unix_ms_}};
  }

  /// @returns how long after 1970-01-01T00:00:00Z `t` is.
  constexpr duration unix_time(time_point t) const {
    return std::chrono::milliseconds{epoch_unix_ms_} + t.time_since_epoch();
  }

  /// @returns the clock of somebody whose time of day is ahead of ours, to the
  /// millisecond, as read on our run's clock.
  constexpr its_clock ahead_by(duration d) const {
    return its_clock{
        epoch_unix_ms_
        + std::chrono::round<std::chrono::milliseconds>(d).count()};
  }

  constexpr std::int64_t epoch_unix_ms() const { return epoch_unix_ms_; }

private:
  std::int64_t epoch_unix_ms_;
};

/// TimestampIts mod 65536, as CAM, CPM TR 103 562 and MCM carry it.
using wrapped_ms = std::uint16_t;

constexpr wrapped_ms to_delta_time(its_ms its) {
  return static_cast<wrapped_ms>(its); // modulo, also of negative
}

/// @returns how old a message is at `now`, ms, in [-32767, 32768]; negative
/// when the sender's clock is ahead of ours.
constexpr int age_ms(wrapped_ms generated, its_ms now) {
  const int age = static_cast<std::uint16_t>(to_delta_time(now) - generated);
  return age <= 32768 ? age : age - 65536;
}

/// @returns the moment nearest to `now` that `generated` can stand for.
constexpr its_ms unwrap(wrapped_ms generated, its_ms now) {
  return now - age_ms(generated, now);
}

} // namespace sofof::messages::etsi
