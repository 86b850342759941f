// Named, counter-based random draws: the value of draw n of a stream does not
// depend on which other draws were made (common random numbers).
#pragma once

#include <cstdint>
#include <string_view>

namespace sofof {

/// A stream of draws, addressed by a counter. Cheap to copy; has no state
/// besides its key. Draws of one counter share their bits whatever their
/// distribution: use lanes to tell them apart.
class random_stream {
public:
  random_stream(std::uint64_t seed, std::string_view name);

  /// A stream of its own for a part of this one, e.g. one vehicle.
  random_stream part(std::string_view name) const;
  random_stream part(std::uint64_t number) const;

  /// @returns 64 random bits; `lane` tells several draws of one counter
  /// apart.
  std::uint64_t bits(std::uint64_t counter, std::uint32_t lane = 0) const;

  /// @returns a number in (0, 1), never an end.
  double uniform(std::uint64_t counter, std::uint32_t lane = 0) const;
  double uniform(double low, double high, std::uint64_t counter,
                 std::uint32_t lane = 0) const;
  double normal(double mean, double sd, std::uint64_t counter,
                std::uint32_t lane = 0) const;
  double exponential(double mean, std::uint64_t counter,
                     std::uint32_t lane = 0) const;
  /// Log-normal with the given mean and standard deviation of the value.
  /// @param mean  > 0.
  double lognormal(double mean, double sd, std::uint64_t counter,
                   std::uint32_t lane = 0) const;
  /// @param a, b  Shapes, at least 0.05 (less runs out of digits).
  /// @returns a number in [0, 1].
  double beta(double a, double b, std::uint64_t counter,
              std::uint32_t lane = 0) const;

private:
  explicit random_stream(std::uint64_t key) : key_{key} {}
  std::uint64_t key_;
};

} // namespace sofof
