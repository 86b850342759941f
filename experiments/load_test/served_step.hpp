// How well a provider served while so many vehicles asked it.
#pragma once

#include "base/statistics.hpp"
#include "base/time.hpp"
#include "experiments/report/run_files.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace sofof::experiments::load_test {

/// What came of one number of vehicles.
struct served_step {
  std::int64_t vehicles = 0;
  std::size_t served = 0; ///< Of them: who got results.
  std::uint64_t results = 0;
  std::uint64_t due = 0; ///< Results, if all were served all the time.
  double measured_s = 0;
  /// At the provider: from when a cycle was due to its result, that is waiting
  /// and computing.
  distribution response;
  distribution latency;        ///< From a cycle's begin to its result here.
  std::uint64_t fallbacks = 0; ///< Results that a vehicle took back early.
  double cores = 0;            ///< That this process kept busy.
  double exchanged_per_s() const {
    return measured_s > 0 ? static_cast<double>(results) / measured_s : 0;
  }
};

/// Which of a step's results count.
struct counted_window {
  double from_s = 0;  ///< When they came: sessions have begun by then, ...
  double until_s = 0; ///< ... and none has ended.
  duration period{};  ///< Of the service's cycles; > 0.
};

/// Adds what results tell of waiting, computing and their way. When a cycle was
/// due the provider does not say; but cycles of a session are a period apart,
/// so it was due as late after its number's period began as the earliest of the
/// session began. A cycle that is missing between two others was a whole period
/// late, or more.
/// @param lines  Of one service, those of a session in the order they came.
void count_results(std::span<const report::cycle_line> lines,
                   const counted_window& window, served_step& to);

} // namespace sofof::experiments::load_test
