// What holds between the parts of one vehicle: its selectors do what its
// requester decides.
#pragma once

#include "experiments/conformance/breach.hpp"
#include "messages/protocol/trace.hpp"

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace sofof::experiments::conformance {

/// Compares the steps of requesters with those of their selectors, in any
/// order. Nothing gets lost between them, so each step of one side has one of
/// the other; but a part that has no later step may have died before. Rule:
/// docs/trace.md, M3.
class vehicle_rules {
public:
  /// @param slack  So much later than a step may the other one's be. ≥ 0.
  vehicle_rules(duration slack, breach_sink found)
      : slack_{slack}, found_{std::move(found)} {}

  void add(const messages::trace_record& x, trace_place at);

  /// There are no more steps.
  void finish();

private:
  enum side : std::size_t { requester, selector };

  /// Which trace and station; of a selector the service.
  struct part {
    std::size_t trace = 0;
    station_id station = 0;
    messages::service_name service;
    friend auto operator<=>(const part&, const part&) = default;
  };

  struct made_step {
    time_point when;
    trace_place at;
  };

  /// What both sides do, or say, once.
  struct common_step {
    part of; // the selector
    std::array<std::optional<made_step>, 2> by;
  };

  duration slack_;
  breach_sink found_;
  std::map<std::string, common_step> steps_;
  std::map<std::pair<side, std::string>, int> times_; // each was made
  std::map<part, time_point> last_; // steps; of a requester without service
};

} // namespace sofof::experiments::conformance
