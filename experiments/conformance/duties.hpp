// What a part of the protocol has to do by a certain time.
#pragma once

#include "base/time.hpp"
#include "experiments/conformance/breach.hpp"

#include <map>
#include <string>

namespace sofof::experiments::conformance {

/// Duties of one part, each under a name. One that is not done in time is
/// found with the part's next step: a part that has died owes nothing.
class duties {
public:
  /// @param slack  So late a duty may be done: where time is real, timers are
  ///               late. ≥ 0.
  duties(duration slack, breach_sink found)
      : slack_{slack}, found_{std::move(found)} {}

  /// @param name  One that is owed already is owed by this time instead.
  /// @param at    The step that makes it a duty.
  void owe(std::string name, time_point by, rule owed_by, trace_place at);

  /// It is done, or need not be done any more.
  void settle(const std::string& name) { owed_.erase(name); }

  bool is_owed(const std::string& name) const { return owed_.contains(name); }

  /// A step was made at this time: all that was to be done before is due.
  void pass(time_point now);

  void drop_all() { owed_.clear(); }

private:
  struct duty {
    time_point by;
    rule owed_by;
    trace_place at;
  };

  duration slack_;
  breach_sink found_;
  std::map<std::string, duty> owed_;
  time_point soonest_ = time_point::max(); // of those owed, or earlier
};

} // namespace sofof::experiments::conformance
