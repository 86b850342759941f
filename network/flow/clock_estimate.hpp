// How far the clock of another host is ahead of ours.
#pragma once

#include "base/time.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace sofof::network {

/// The four stamps of a question and its answer (RFC 5905: origin, receive,
/// transmit and destination timestamp).
struct clock_exchange {
  time_point asked;    // on our clock
  time_point heard;    // on theirs
  time_point answered; // on theirs
  time_point received; // on ours
};

/// What another clock shows more than ours.
struct clock_offset {
  duration ahead; // theirs minus ours, the best guess
  duration doubt; // the truth lies within ahead ± doubt
};

/// Follows the clock of another host by exchanges of stamps with it, many a
/// second; the same clock may be early or late, drift and step.
///
/// As no message arrives before it was sent, each exchange says between what
/// the offset lies. Of each second heard the narrowest limits are kept, those
/// of the quickest message each way, on their own. The limits of the last 8 s
/// make `doubt`, about half of the best round trip; as they grow with age by
/// the most that clocks drift apart, 200 ppm, they hold for certain, however
/// the delays are spread over the two ways. `ahead` lies in the middle, with
/// the limits moved along by the drift, which is fitted to the last 64 s.
///
/// An exchange that contradicts the limits tells of a step of either clock or
/// is nonsense: 5 that agree with each other within 2 s are a step, after
/// which all is estimated anew. A step below twice the doubt looks like a
/// change of delays and may be seen only after 8 s. Whatever a lying peer
/// claims only misplaces its own estimate.
class clock_estimate {
public:
  /// Learns from an exchange, in any order and any number of times. Impossible
  /// stamps, those of strangers in time (`is_plausible`), and round trips of
  /// more than 10 s are ignored.
  void add(const clock_exchange& exchange);

  /// @param now  On our clock.
  /// @returns nullopt before the first exchange, and for an implausible `now`.
  std::optional<clock_offset> at(time_point now) const;

  /// @returns by how much their clock is faster than ours, within ±200 ppm; 0
  /// as long as nothing is known.
  double drift_ppm() const { return drift_ * 1e6; }

  /// @returns how many steps of a clock were noticed.
  std::uint64_t steps() const { return steps_; }

private:
  /// What the offset was at least or at most at a time.
  struct limit {
    time_point at;
    duration ahead;
  };
  /// What was heard of the offset from a time on.
  struct limits {
    time_point begin;
    limit least;
    limit most;
  };
  static constexpr std::size_t slots_kept = 64;

  static limits told_by(const clock_exchange& exchange);
  static void narrow(limits& known, const limits& told);
  static bool agree(const limits& one, const limits& other);

  std::size_t oldest(std::size_t number) const;
  limits& slot(std::size_t n) { return slots_[n % slots_kept]; }
  const limits& slot(std::size_t n) const { return slots_[n % slots_kept]; }

  bool believable(const limits& told) const;
  void keep(const limits& told);
  void suspect(const limits& told);
  double fitted_drift() const;

  std::array<limits, slots_kept> slots_{}; // of a second each, in turn
  std::size_t opened_ = 0;                 // slots since the last step
  double drift_ = 0;                       // s/s
  limits other_{};                         // told against the slots,
  int contradictions_ = 0;                 // so often
  std::uint64_t steps_ = 0;
};

} // namespace sofof::network
