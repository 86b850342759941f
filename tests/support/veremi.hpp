// The position attacks of VeReMi: what an attacker tells instead of where it
// is. Source: van der Heijden, Lukaseder & Kargl, VeReMi: A Dataset for
// Comparable Evaluation of Misbehavior Detection in VANETs, SecureComm 2018
// (arXiv 1804.06701), table 1.
#pragma once

#include "base/geometry.hpp"
#include "base/random.hpp"
#include "world/sensing/perception.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

namespace sofof::test {

enum class veremi : std::uint8_t {
  constant,        ///< 1: one place, for ever.
  constant_offset, ///< 2: so far beside itself.
  random,          ///< 4: anywhere on the playground, anew each time.
  random_offset,   ///< 8: up to 300 m beside itself, anew each time.
  eventual_stop,   ///< 16: as it is, until it seems to stop.
};

inline constexpr std::array veremi_kinds{
    veremi::constant, veremi::constant_offset, veremi::random,
    veremi::random_offset, veremi::eventual_stop};

inline std::string_view name_of(veremi x) {
  constexpr std::array<std::string_view, 5> names{"constant", "constant offset",
                                                  "random", "random offset",
                                                  "eventual stop"};
  return names[static_cast<std::size_t>(x)];
}

/// What one attacker tells, word by word.
class veremi_attacker {
public:
  /// @param ground  Corners of the playground, m: VeReMi's is a part of
  ///                Luxembourg, ours is where a test drives. The place of the
  ///                constant attack, (5560, 5820) there, is `stands` here.
  veremi_attacker(veremi kind, random_stream dice, point low, point high,
                  point stands)
      : kind_{kind}, dice_{dice}, low_{low}, high_{high}, stands_{stands} {}

  /// @returns what it tells when it is really there. The first words of an
  /// eventual stop are true: see `lies`.
  world::perceived_object told(world::perceived_object real) {
    const auto n = ++words_;
    const auto drawn = [&](double low, double high, std::uint32_t what) {
      return low + (high - low) * dice_.uniform(n, what);
    };
    switch (kind_) {
      case veremi::constant:
        real.centre = stands_;
        break;
      case veremi::constant_offset:
        real.centre = real.centre + point{250, -150};
        break;
      case veremi::random:
        real.centre = {drawn(low_.x_m, high_.x_m, 0),
                       drawn(low_.y_m, high_.y_m, 1)};
        break;
      case veremi::random_offset:
        real.centre =
            real.centre + point{drawn(-300, 300, 0), drawn(-300, 300, 1)};
        break;
      case veremi::eventual_stop:
        // The probability to stop grows by 0.025 with each word.
        if (!stopped_ && dice_.uniform(n, 2) < 0.025 * static_cast<double>(n))
          stopped_ = real;
        if (stopped_) {
          real = *stopped_;
          real.speed_mps = real.accel_mps2 = 0;
        }
        break;
    }
    return real;
  }

  /// @returns whether its last word was a lie.
  bool lies() const { return kind_ != veremi::eventual_stop || stopped_; }

private:
  veremi kind_;
  random_stream dice_;
  point low_, high_, stands_;
  std::uint64_t words_ = 0;
  std::optional<world::perceived_object> stopped_;
};

} // namespace sofof::test
