// A bandit for providers that come and go and tasks of different sizes.
#pragma once

#include "base/ids.hpp"

#include <cassert>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace sofof::policies {

/// Constants of ALTO; the paper leaves them to the user.
struct alto_options {
  /// Weight of exploration, ≥ 0. 2 would be that of UCB1, made for the worst
  /// case; with 0.5 a provider whose promise, for a small task, is above its
  /// true mean is as rare as 1/t at most (Hoeffding's bound).
  double beta = 0.5;
  /// What a delay per bit is measured by, s/bit, > 0: what is worse counts as
  /// this. By default 50 ms, the latency limit, for 160 kbit.
  double worst_delay_s_per_bit = 0.050 / 160e3;
  /// A task up to `small_bits` explores most, one of `large_bits` or more not
  /// at all; 0 ≤ small < large. By default half and twice of 160 kbit.
  double small_bits = 80e3;
  double large_bits = 320e3;
};

/// Learns which provider has the least mean delay per bit, u, in parts of the
/// worst. Chooses the least of
///
///   u − √(β (1 − x) ln(t − a) / k),
///
/// t being the tasks so far, a their number when the provider appeared, and k
/// the results heard of it. The size x of the task, from 0 (small) to 1
/// (large), has trials be made when they cost least; a provider that appears
/// late is tried as hard as one that was there at the start. A choice costs
/// O(providers present · log(providers ever met)).
///
/// Source: Sun, Guo, Song, Zhou, Jiang, Liu & Niu 2019 (ALTO).
class alto {
public:
  explicit alto(const alto_options& options) : options_{options} {
    assert(options.beta >= 0 && options.worst_delay_s_per_bit > 0);
    assert(0 <= options.small_bits && options.small_bits < options.large_bits);
  }

  /// Counts a task.
  /// @param task_bits  Size of its input, > 0.
  /// @param present    Who may get it, in any order.
  /// @returns of these one without a result so far, the lowest id first; else
  /// the most promising; nullopt when none is present.
  std::optional<provider_id> choose(double task_bits,
                                    std::span<const provider_id> present);

  /// Learns from the end of a task; one that is lost took the worst delay, or
  /// its provider would be tried again and again. A provider that was never
  /// present is ignored.
  /// @param task_bits  Size of its input, > 0.
  /// @param delay_s    From input to result, ≥ 0.
  void learn(provider_id provider, double task_bits, double delay_s);

  std::string snapshot() const;
  /// @returns why the text is no snapshot of a learner with the same worst
  /// delay, and then all stays as it was; else nullopt.
  std::optional<std::string> restore(std::string_view snapshot);

private:
  struct record {
    std::uint64_t appeared = 0; // number of the task
    std::uint64_t results = 0;
    double mean_delay = 0; // per bit, in parts of the worst
  };
  double promise(const record& known, double task_bits) const;

  alto_options options_;
  std::map<provider_id, record> known_;
  std::uint64_t tasks_ = 0;
};

} // namespace sofof::policies
