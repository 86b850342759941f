// What the deciders see, and what they say.
#pragma once

#include "policies/policy.hpp"
#include "policies/schedule/periodic_task.hpp"
#include "world/geometry.hpp"
#include "world/ids.hpp"
#include "world/random.hpp"
#include "world/road_map.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace sofof {

/// What a vehicle knows of a provider.
struct provider_view {
  boot_id id = 0;
  point at; ///< m, east-north.
  /// What runs there needs this share of its workers, as it says, ≥ 0; above 1
  /// it falls behind.
  double utilisation = 0;
};

/// What a requester weighs: one of its services, and who offers it.
struct local_context {
  time_point now;
  std::string_view kind;
  /// Those that may be asked now: first who offers it just now, then by id.
  std::span<const provider_view> providers;
  std::span<const point> path; ///< Planned, from the vehicle on, m.
  double speed_mps = 0;
  random_stream noise{0, ""}; ///< Of this vehicle's decisions.
  std::uint64_t number = 0;   ///< Of this decision: the counter of `noise`.
};

struct local_decision {
  boot_id source = 0;   ///< The provider to be asked; 0: the vehicle itself.
  std::string_view why; ///< A short literal, for the records.
};

/// One service that a vehicle asks for.
struct request_view {
  station_id station = 0;
  std::string_view kind;
  std::span<const point> route; ///< Planned, m, at least 1.
  double speed_mps = 0;
  double utilisation = 0; ///< What it would add to that of the provider.
  /// How it computes on one worker: `wcet` is its mean and three standard
  /// deviations more, `deadline` the latency that it may have.
  periodic_task task;
};

/// One service of one station that runs now.
struct session_view {
  station_id station = 0;
  std::string_view kind;
  time_point since;
  periodic_task task;     ///< With the offset that was assigned, or drawn.
  std::size_t worker = 0; ///< As `central_decision` has it.
};

/// What a provider weighs: requests, and what runs already.
struct central_context {
  time_point now;
  std::span<const request_view> requests; ///< That came together.
  std::span<const session_view> sessions; ///< Of all stations.
  double utilisation = 0;                 ///< Of its workers, by the sessions.
  std::size_t workers = 1;
  const polygon& area;
  const road_map& map;
};

struct central_decision {
  bool accept = false;
  std::string_view why;   ///< A short literal, for the records.
  std::size_t worker = 0; ///< That it counts on.
  /// When in the period its cycles begin; drawn if nobody assigns it.
  std::optional<duration> offset{};
};

/// LODM: local offloading decision making, in the vehicle.
using local_policy = policy<local_context, local_decision>;

/// CODM: centralised offloading decision making, at the provider; one
/// decision per request, in their order.
using central_policy = policy<central_context, std::vector<central_decision>>;

} // namespace sofof
