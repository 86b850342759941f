// What a service computes: from an input to a result, cycle by cycle.
#pragma once

#include "messages/protocol/service.hpp"

#include <utility>

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

  /// An input comes while the function does not run. What it knows of the world
  /// should be as good when it has to take over at once; it computes no result.
  virtual void observe(time_point /*now*/,
                       const messages::service_input& /*input*/) {}
};

} // namespace sofof::offloading
