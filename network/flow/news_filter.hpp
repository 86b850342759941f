// Which news of a peer, which may come and go all the time, people hear.
#pragma once

#include "base/time.hpp"
#include "network/flow/token_bucket.hpp"

#include <string>

namespace sofof::network {

/// Lets a sentence pass that differs from the one before it: one a second, and
/// twenty at once.
class news_filter {
public:
  /// @returns whether people shall hear this.
  bool passes(const std::string& sentence, time_point now) {
    if (sentence == last_ || !allowance_.try_spend(now))
      return false;
    last_ = sentence;
    return true;
  }

private:
  static constexpr double per_second = 1;
  static constexpr double at_once = 20;

  std::string last_; // that has passed
  token_bucket allowance_{per_second, at_once};
};

} // namespace sofof::network
