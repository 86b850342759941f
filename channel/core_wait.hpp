// One computer for the software of all vehicles: how long it has to wait there.
#pragma once

#include "base/options/option_visitor.hpp"
#include "base/random.hpp"
#include "base/time.hpp"

#include <chrono>
#include <cstdint>

namespace sofof::channel {

/// A computer that runs the software of all vehicles, as where a stack of each
/// is tried out on one machine.
struct host_options {
  std::int64_t cores = 0; ///< 0: each vehicle has a computer of its own.
  double busy_cores = 0;  ///< That the software of one vehicle keeps busy.
  /// Mean time for which a core is taken before another thread has it.
  duration turn = std::chrono::milliseconds{4};

  void visit_options(option_visitor& s) {
    using namespace std::chrono_literals;
    s.field("cores", cores, {0, 1024});
    s.field("busy_cores", busy_cores, {0, 1024});
    s.field("turn", turn, 0ns);
    if (cores == 0 && busy_cores > 0)
      s.refuse("busy_cores", "has no effect while cores is 0.");
  }

  /// @returns whether it does all that so many vehicles ask for.
  bool carries(std::int64_t vehicles) const;
};

/// How long a thread that has something to do waits for a core; at random, as
/// others come at random. The default waits for nothing.
struct core_wait {
  double probability = 0; ///< That no core is free, 0 … 1.
  duration mean{};        ///< Of the waits then; they are exponential.

  /// @returns draw `number` of a wait.
  duration draw(const random_stream& stream, std::uint64_t number) const;
};

/// @param vehicles  Whose software the host carries.
/// @returns the wait in a queue before `cores` servers, in the long run
/// (M/M/c). Source: Erlang, Solution of some Problems in the Theory of
/// Probabilities of Significance in Automatic Telephone Exchanges, 1917 (his
/// formula C).
core_wait wait_for_core(const host_options& host, std::int64_t vehicles);

} // namespace sofof::channel
