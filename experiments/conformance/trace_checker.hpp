// Follows all parts of the protocol through a trace, and finds the rules that
// they break.
#pragma once

#include "experiments/conformance/breach.hpp"
#include "experiments/conformance/chain_rules.hpp"
#include "experiments/conformance/message_rules.hpp"
#include "experiments/conformance/provider_rules.hpp"
#include "experiments/conformance/requester_rules.hpp"
#include "experiments/conformance/selector_rules.hpp"
#include "experiments/conformance/vehicle_rules.hpp"
#include "messages/protocol/trace.hpp"

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

namespace sofof::experiments::conformance {

/// Takes steps one by one: those of each part in their order, those of
/// different parts in any. A part that starts again, at step 1, is a new one.
class trace_checker {
public:
  /// @param slack  Of timers: zero in virtual time. ≥ 0.
  /// @param chain  Which services follow which; empty: none does.
  explicit trace_checker(duration slack, services_before chain = {});
  trace_checker(const trace_checker&) = delete;
  trace_checker& operator=(const trace_checker&) = delete;

  /// @param x  A step of a selector, or a step about one session, has exactly
  ///           one service (`is_well_formed`).
  void add(const messages::trace_record& x, trace_place at);

  /// There are no more steps.
  /// @returns all breaches, in the order of their places.
  const std::vector<breach>& finish();

  std::uint64_t steps() const { return steps_; }

  /// @returns whether a step names as many services as its kind does.
  static bool is_well_formed(const messages::trace_record& x);

private:
  /// Who, in which trace.
  using part_key = std::tuple<std::size_t, messages::trace_part, provider_id,
                              station_id, messages::service_name>;

  template <class Rules>
  struct followed {
    Rules rules;
    std::uint64_t last_step = 0;
  };
  template <class Rules>
  using parts = std::map<part_key, followed<Rules>>;

  template <class Rules>
  void follow(parts<Rules>& all, const part_key& who,
              const messages::trace_record& x, trace_place at);
  breach_sink sink();

  duration slack_;
  std::vector<breach> breaches_;
  parts<requester_rules> requesters_;
  parts<provider_rules> providers_;
  parts<selector_rules> selectors_;
  message_rules messages_;
  vehicle_rules vehicles_;
  chain_rules chains_;
  std::uint64_t steps_ = 0;
};

} // namespace sofof::experiments::conformance
