// What holds between the services of a chain in one vehicle.
#pragma once

#include "experiments/conformance/breach.hpp"
#include "messages/protocol/trace.hpp"

#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace sofof::experiments::conformance {

/// Of a service that follows another one in a chain, that one.
using services_before =
    std::map<messages::service_name, messages::service_name>;

/// Compares what selectors of one vehicle get with what those before them in a
/// chain let through, in any order of parts. A vehicle that has no selector of
/// the service before has no chain. Rules: docs/trace.md, C1 ff.
class chain_rules {
public:
  /// @param slack  So much later may an input be. ≥ 0.
  chain_rules(duration slack, services_before chain, breach_sink found)
      : slack_{slack}, chain_{std::move(chain)}, found_{std::move(found)} {}

  /// @param x  Those of one part in their order.
  void add(const messages::trace_record& x, trace_place at);

  /// There are no more steps.
  void finish();

private:
  using service = messages::service_name;

  /// In which trace, of which station.
  struct vehicle {
    std::size_t trace = 0;
    station_id station = 0;
    friend auto operator<=>(const vehicle&, const vehicle&) = default;
  };

  struct made_step {
    time_point when;
    trace_place at;
  };

  /// What the selector of one service has got, and let through.
  struct stage {
    std::vector<made_step> inputs, results;
    std::optional<trace_place> result_of_none; // used before any input
    time_point last;                           // step
  };

  struct closing {
    messages::traced_service what;
    made_step step;
  };

  /// The latest closings in one instant.
  struct end_of_sessions {
    std::vector<closing> violated, released;
    time_point when;
  };

  bool is_part_of_chain(const service& name) const;
  void on_closed(const messages::trace_record& x, trace_place at);
  void compare(station_id station, const end_of_sessions& ends);
  void compare(const vehicle& of, const service& name, const stage& before,
               const stage& next);

  duration slack_;
  services_before chain_;
  breach_sink found_;
  std::map<std::pair<vehicle, service>, stage> stages_;
  std::map<vehicle, end_of_sessions> ends_;
};

} // namespace sofof::experiments::conformance
