// Repeatable random numbers for property tests (a linear congruential
// generator; constants: Knuth's MMIX).
#pragma once

#include <cstdint>

namespace sofof::test {

class dice {
public:
  explicit dice(std::uint64_t seed) : state_{seed} {}

  /// @returns a number in [low, high).
  double between(double low, double high) {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * static_cast<double>(state_ >> 11) * 0x1p-53;
  }

private:
  std::uint64_t state_;
};

} // namespace sofof::test
