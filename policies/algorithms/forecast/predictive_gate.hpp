// Lets offloading through only where the forecast is good.
#pragma once

#include <cassert>

namespace sofof::policies {

/// A gate on the forecast probability of a violation, closed at first, with
/// two thresholds so that it does not flutter: it opens at p ≤ on and closes at
/// p > off. It can only avoid what can be foreseen; the rest is left to
/// redundancy and the watchdog.
class predictive_gate {
public:
  /// @param on   Opens at this probability or less, in [0, 1].
  /// @param off  Closes above this probability, in [on, 1].
  predictive_gate(double on, double off) : on_{on}, off_{off} {
    assert(0 <= on && on <= off && off <= 1);
  }

  /// @param p  Of a violation, in [0, 1]; what is no number closes.
  /// @returns whether the gate is open from now on.
  bool update(double p) {
    open_ = p <= (open_ ? off_ : on_);
    return open_;
  }

  bool open() const { return open_; }

private:
  double on_;
  double off_;
  bool open_ = false;
};

} // namespace sofof::policies
