// One choice of a bandit, and what comes of it until the next.
#pragma once

#include "base/ids.hpp"
#include "base/time.hpp"

#include <cassert>
#include <optional>

namespace sofof::policies {

/// A service is at one place for a while, or on the way there.
class bandit_trial {
public:
  bandit_trial() = default;
  bandit_trial(service_place place, time_point begin)
      : place_{place}, begin_{begin}, is_open_{true} {}

  service_place place() const { return place_; }
  bool is_open() const { return is_open_; }
  /// @returns whether it has lasted so long.
  bool lasted(duration length, time_point now) const {
    return now - begin_ >= length;
  }

  /// @param value  Of each of so many cycles; finite.
  void add(double value, double cycles) {
    assert(std::isfinite(value));
    sum_ += value * cycles;
    cycles_ += cycles;
  }
  /// Nothing more comes of it.
  void close() { is_open_ = false; }

  /// @returns the mean value of a cycle; nullopt before any.
  std::optional<double> mean() const {
    return cycles_ > 0 ? std::optional{sum_ / cycles_} : std::nullopt;
  }

private:
  service_place place_;
  time_point begin_;
  bool is_open_ = false;
  double sum_ = 0;
  double cycles_ = 0;
};

} // namespace sofof::policies
