// How much of something a peer may have in a while.
#pragma once

#include "base/time.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::network {

/// A bucket of tokens that fills at a steady rate; whoever wants something
/// spends tokens on it. Full at first.
class token_bucket {
public:
  /// @param per_second  Tokens that come each second, ≥ 0.
  /// @param burst       Tokens that the bucket holds, ≥ 0.
  token_bucket(double per_second, double burst)
      : per_second_{per_second}, burst_{burst}, tokens_{burst} {
    assert(per_second >= 0 && burst >= 0);
  }

  /// Spends `n` ≥ 0 tokens if there are as many, else none. While time is
  /// behind the latest that was seen, no tokens come.
  /// @returns whether they were spent.
  bool try_spend(time_point now, double n = 1) {
    fill(now);
    if (!(n >= 0 && n <= tokens_)) // nor what is no number
      return false;
    tokens_ -= n;
    return true;
  }

private:
  void fill(time_point now) {
    if (now <= latest_)
      return;
    // Differences of any two time points fit into seconds.
    const auto passed_s = to_seconds(now) - to_seconds(latest_);
    tokens_ = std::min(burst_, tokens_ + per_second_ * passed_s);
    latest_ = now;
  }

  double per_second_;
  double burst_;
  double tokens_;
  time_point latest_ = time_point::min();
};

} // namespace sofof::network
