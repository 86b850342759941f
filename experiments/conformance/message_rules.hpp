// What holds between the parts: nothing is got that was not sent, and what runs
// here has begun there.
#pragma once

#include "experiments/conformance/breach.hpp"
#include "messages/protocol/trace.hpp"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <tuple>

namespace sofof::experiments::conformance {

/// Compares the steps of all parts, in any order; of those that have none, none
/// are missed. Rules: docs/trace.md, M1 ff.
class message_rules {
public:
  explicit message_rules(breach_sink found) : found_{std::move(found)} {}

  void add(const messages::trace_record& x, trace_place at);

  /// There are no more steps.
  void finish();

private:
  /// What stands for a message, or a session, on both sides.
  using name = std::string;

  struct got {
    trace_place at;
    bool from_provider = false;
    provider_id provider = 0;
    station_id station = 0;
    std::uint64_t refused = 0; // the number of the request, if it is a refusal
  };

  breach_sink found_;
  std::set<name> sent_;
  std::map<name, got> got_; // for the first time
  /// Which requests each provider has got, by station and number.
  std::set<std::tuple<provider_id, station_id, std::uint64_t>> asked_;
  std::set<provider_id> providers_;
  std::set<station_id> requesters_; // whose steps there are
};

} // namespace sofof::experiments::conformance
