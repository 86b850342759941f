// What the deciders see.
#pragma once

#include "base/candidate.hpp"
#include "base/geometry.hpp"
#include "base/ids.hpp"
#include "base/random.hpp"
#include "policies/algorithms/splits/chain_response.hpp"
#include "policies/api/decision.hpp"
#include "policies/api/gain.hpp"
#include "policies/api/periodic_task.hpp"
#include "policies/api/policy.hpp"
#include "policies/api/quality_forecast.hpp"
#include "world/roads/road_map.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace sofof::policies {

/// What a vehicle expects of results by what came so far; without any the
/// worst.
struct link_quality {
  double late = 1; ///< P(a result is later than its limit), in [0, 1].
  double gap = 1;  ///< P(the gap to the next one is longer than its limit).
  /// Latencies that half and 99 % of the results stay below; unknown at first.
  std::optional<duration> median{}, p99{};
};

/// What a vehicle knows of a provider.
struct provider_view {
  provider_id id = 0;
  point at; ///< m, east-north.
  /// What runs there needs this share of its workers, as it says, ≥ 0; above 1
  /// it falls behind.
  double utilisation = 0;
  std::size_t workers = 1;
  /// Mean computing time of a result of this service there, without a wait.
  double computing_s = 0;
  link_quality link{};
  /// Of a cycle that is planned there, for the vehicle.
  world::cycle_cost cost{};
  point velocity_mps{}; ///< East and north; 0: it stands.
  /// Of one that rides with a vehicle: it serves who is nearer, m.
  std::optional<double> reach_m{};
};

/// What a cycle at this provider costs less than one on board, without unit: <
/// 0 where it costs more. Where nothing came yet, latency is computing and way.
/// @param on_board  Of a cycle in the vehicle.
double gain(const provider_view& provider, const world::cycle_cost& on_board,
            const service_needs& needs, const cost_weights& weights = {});

/// What results of a provider will be like for a while.
struct foreseen_results {
  std::optional<time_point> late; ///< Creation of the first late or lost one.
  double latency_s = 0;           ///< Mean of those before; 0 without any.
};

/// What is to come, for who wants to know what the best would have been. What
/// others do meanwhile is not foreseen.
class channel_oracle {
public:
  virtual ~channel_oracle() = default;

  /// @returns what is foreseen of results that are created from `from` on and
  /// before `until`.
  virtual foreseen_results look(provider_id provider, std::string_view service,
                                time_point from, time_point until) const = 0;
};

/// What a vehicle knows of one service of its chain.
struct chain_link {
  std::string_view service; ///< Its name.
  /// Where it runs; while it moves, where it goes to.
  service_place place{};
  bool moves = false;
  /// Where it runs, and those that may be asked for it now.
  std::vector<provider_view> providers;
  service_needs needs{};
  world::cycle_cost on_board{}; ///< Of a cycle in the vehicle.
  double resting_j = 0;         ///< Of a cycle that another one computes, J.
  service_times times{};        ///< As measured so far.
};

/// What a requester weighs: one of its services, and where it may run.
struct local_context {
  time_point now;
  std::string_view service;
  /// First where it runs, then those that may be asked now: who offers it just
  /// now, then the others by id.
  std::span<const provider_view> providers;
  std::span<const point> path; ///< Planned, from the vehicle on, m.
  double speed_mps = 0;
  random_stream noise{0, ""}; ///< Of this vehicle's decisions.
  std::uint64_t number = 0;   ///< Of this decision: the counter of `noise`.

  service_place current{}; ///< Where it runs.
  time_point since{};      ///< When it came there.
  service_needs needs{};
  world::cycle_cost on_board{}; ///< Of a cycle that is planned in the vehicle.
  /// The longest response time under which the scene is safe; nullopt: the
  /// service does not say.
  std::optional<duration> safe_response{};
  /// All services of the vehicle's chain, in its order; empty if they form
  /// none.
  std::span<const chain_link> chain{};
  /// Only where a run can tell; null elsewhere.
  const channel_oracle* future = nullptr;
  /// Where it runs, in case a filter keeps that from `providers`:
  /// `where_it_runs`.
  const provider_view* here = nullptr;
  station_id station = 0; ///< Of the vehicle.
  /// What results will be like along the path, by provider; empty for a policy
  /// that does not want it (`policy::needs_forecast`), or without a source.
  std::span<const provider_forecast> forecasts{};
};

/// @returns what is known of where the service runs, whatever a filter says of
/// it; null when it runs in the vehicle.
inline const provider_view* where_it_runs(const local_context& context) {
  if (context.here || !context.current)
    return context.here;
  const auto& all = context.providers;
  const auto found =
      std::ranges::find(all, *context.current, &provider_view::id);
  return found == all.end() ? nullptr : &*found;
}

/// Where a service is for a vehicle, as far as a provider can know.
enum class link_place {
  none,      ///< There is no such service, that the provider knew of.
  elsewhere, ///< In the vehicle, or at another provider: it is not told.
  asked,     ///< The vehicle asks for it now, too.
  here,      ///< This provider runs it for the vehicle.
};

/// A service next to another one in a chain.
struct linked_service {
  std::string_view service; ///< Its name; empty for `none`.
  link_place at = link_place::none;
};

/// What a provider knows of the chain that a service is part of.
struct chain_links {
  linked_service follows;     ///< Of whose results its inputs are made.
  linked_service followed_by; ///< Whose inputs are made of its results; one
                              ///< that is not offered here is not known.
};

/// One service that a vehicle asks for.
struct request_view {
  station_id station = 0;
  std::string_view service;
  std::span<const point> route; ///< Planned, m; a vehicle may tell none.
  double speed_mps = 0;
  double utilisation = 0; ///< What it would add to that of the provider.
  /// How it computes on one worker: `wcet` is its mean and three standard
  /// deviations more, `deadline` the latency that it may have.
  periodic_task task{};
  /// The same, with a C that none of its cycles exceeds but for `overrun`, and
  /// the jitter of cycles that are called by inputs.
  periodic_task at_most{};
  /// What the vehicle wins by each provider that it could ask, this one among
  /// them: policies/api/gain.hpp. Of services that it asks for together, it is
  /// told for the first, and all have the same.
  std::span<const candidate> candidates{};
  chain_links links{};
};

/// One service of one station that runs now.
struct session_view {
  station_id station = 0;
  std::string_view service;
  time_point since;
  periodic_task task;     ///< With the offset that was assigned, or drawn.
  std::size_t worker = 0; ///< As `accepted` has it.
  double utilisation = 0; ///< What it adds to that of the provider.
  std::span<const candidate> candidates{}; ///< As the vehicle asked for it.
  periodic_task at_most{};                 ///< As a request has it.
  chain_links links{};
};

/// What a provider weighs: requests, and what runs already.
struct central_context {
  time_point now;
  std::span<const request_view> requests; ///< That came together.
  std::span<const session_view> sessions; ///< Of all stations.
  double utilisation = 0;                 ///< Of its workers, by the sessions.
  std::size_t workers = 1;
  const polygon& area;
  const world::road_map& map;
  provider_id self = 0;       ///< The provider.
  random_stream noise{0, ""}; ///< Of its decisions.
  std::uint64_t number = 0;   ///< Of this one: the counter of `noise`.
  /// East and north: `area` is where it is now, and moves like this; 0: it
  /// stays.
  point area_velocity_mps{};
};

/// LODM: local offloading decision making, in the vehicle.
using local_policy = policy<local_context, local_decision, provider_view>;

/// CODM: centralised offloading decision making, at the provider: one decision
/// per request, in their order, and then, if it likes, one per session, of
/// which those that are not accepted end (revoked). What is missing is refused,
/// or goes on.
using central_policy =
    policy<central_context, std::vector<central_decision>, request_view>;

} // namespace sofof::policies
