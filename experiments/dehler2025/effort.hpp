// How long a reproduction takes at most, before it begins.
#pragma once

#include "experiments/dehler2025/offloading_time.hpp"
#include "experiments/sweep/plan.hpp"
#include "experiments/sweep/sweep.hpp"

#include <atomic>
#include <cstddef>
#include <iosfwd>
#include <span>
#include <string>

namespace sofof::experiments::study {

struct effort {
  std::size_t runs = 0; ///< At most, in virtual time.
  double hours = 0;     ///< That they take at most, by `probe_s`.
  unsigned jobs = 1;    ///< So many at the same time.
  double probe_s = 0;   ///< What the run took that it was judged by.
};

/// Makes a run with most planning cycles, several of them at a time as all will
/// be, unless they are there, and judges all others by what they took and by
/// their cycles. Shorter ones take less for a cycle, so this is rather too
/// long.
/// @param plans  At least one.
/// @throws input_error when no point can be loaded, or the run is broken.
effort longest_effort(std::span<const sweep_plan> plans,
                      const sweep_options& options, const seed_rule& rule,
                      const std::atomic<bool>& interrupted,
                      std::ostream& console);

/// @returns a sentence for people.
std::string text_of(const effort& e);

} // namespace sofof::experiments::study
