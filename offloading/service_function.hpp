// What a service computes: from an input to a result, cycle by cycle.
#pragma once

#include "messages/protocol/lifecycle.hpp"
#include "messages/protocol/service.hpp"

#include <functional>
#include <utility>
#include <variant>

namespace sofof::offloading {

/// What one cycle of a function gives.
struct service_output {
  messages::payload what;    ///< The result; empty when there is none (yet).
  messages::payload about{}; ///< How it came about, for records.

  service_output() = default;
  // NOLINTNEXTLINE(*-explicit-*): most have nothing to add
  service_output(messages::payload x, messages::payload notes = {})
      : what{std::move(x)}, about{std::move(notes)} {}
};

/// The output of a cycle, or what is left to be computed of one that will most
/// likely give a result: from what is the function's own and from nothing that
/// others change. It reads no clock, and holds nothing of actors.
using begun_cycle =
    std::variant<service_output, std::function<service_output()>>;

/// One running function. It has no clock of its own. In virtual time the same
/// inputs at the same times give the same results. It is called by one thread
/// at a time, not always the same; others of its service may run meanwhile.
class service_function {
public:
  virtual ~service_function() = default;

  /// @param now    Start of the cycle.
  /// @param input  The newest input; its `what` is not empty.
  virtual service_output run(time_point now,
                             const messages::service_input& input) = 0;

  /// Begins a cycle, which may end later, by any thread while the world goes
  /// on: takes from the world what the cycle needs to know as it is now. By
  /// default it is run at once.
  virtual begun_cycle begin(time_point now,
                            const messages::service_input& input) {
    return run(now, input);
  }

  /// An input comes while the function does not run. What it knows of the world
  /// should be as good when it has to take over at once; it computes no result.
  virtual void observe(time_point /*now*/,
                       const messages::service_input& /*input*/) {}

  /// Its life cycle takes a step; before the first cycle that follows from it,
  /// and perhaps while the pool computes what `begin` has left.
  virtual void on_step(messages::lifecycle_step /*step*/, time_point /*now*/) {}

  /// @returns whether a cycle may wait for something that is no computing:
  /// where time is real, the function then has a thread of its own.
  virtual bool blocks() const { return false; }
};

} // namespace sofof::offloading
