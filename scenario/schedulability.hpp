// What a scenario lets its providers promise: how long results take at most.
#pragma once

#include "policies/algorithms/scheduling/response_time.hpp"
#include "scenario/scenario.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sofof::scenario {

/// A service at a provider, when each of so many vehicles runs all that is
/// offered there.
struct service_response {
  std::string service;
  duration limit{}; ///< Of the latency: the way comes on top of the response.
  /// When each session may begin, and its first cycle be run at once; nullopt
  /// if there is no bound.
  std::optional<policies::response_quantile> beginning;
  /// When all run on their grids.
  std::optional<policies::response_quantile> running;

  /// @returns whether hardly any response is longer than the limit.
  bool is_in_time() const;
};

/// Beyond this share of late results, responses do not count as in time.
inline constexpr double most_late = 0.01;

struct provider_schedule {
  std::string provider;
  std::int64_t alike = 0; ///< Others of which the same is true.
  std::int64_t workers = 1;
  std::int64_t vehicles = 0; ///< At once: all that are connected.
  double load = 0;           ///< Longest computing times, of all workers' time.
  std::vector<service_response> services; ///< In the scenario's order.
  /// With how many vehicles at once all are in time, of those that there are.
  std::int64_t in_time_with = 0;
  /// With how many workers all these vehicles are in time; nullopt if with no
  /// number of them that a provider may have.
  std::optional<std::int64_t> workers_needed;

  /// Whether all figures of another provider are the same.
  bool is_like(const provider_schedule& other) const;
};

/// @param place  Of the provider; it offers something.
provider_schedule schedule_of(const scenario_definition& all,
                              std::size_t place);

/// @returns what is stated of it, as comments of a scenario file.
std::string to_comment(const provider_schedule& schedule);

/// @returns in a sentence what may be late; empty if nothing is, or if the
/// CODM sees to it.
std::string warning_of(const provider_schedule& schedule,
                       const scenario_definition& all);

} // namespace sofof::scenario
