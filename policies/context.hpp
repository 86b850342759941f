// What the deciders see, and what they say.
#pragma once

#include "policies/policy.hpp"
#include "world/geometry.hpp"
#include "world/ids.hpp"
#include "world/road_map.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace sofof {

/// What a requester weighs: one offered service of one provider.
struct local_context {
  time_point now;
  std::string_view kind;
  point provider_at;           ///< m, east-north.
  std::span<const point> path; ///< Planned, from the vehicle on, m.
  double speed_mps = 0;
};

struct local_decision {
  bool request = false;
  std::string_view why; ///< A short literal, for the records.
};

/// What a provider weighs: one request, service by service, with everything
/// that runs already.
struct central_context {
  /// One service of one station that runs now.
  struct session {
    station_id station = 0;
    std::string_view kind;
    time_point since;
  };

  time_point now;
  station_id station = 0;
  std::span<const std::string_view> kinds; ///< Requested.
  std::span<const point> route;            ///< Planned, m, at least 1.
  double speed_mps = 0;
  const polygon& area;
  const road_map& map;
  std::span<const session> sessions; ///< Of all stations.
};

struct central_decision {
  bool accept = false;
  std::string_view why; ///< A short literal, for the records.
};

/// LODM: local offloading decision making, in the vehicle.
using local_policy = policy<local_context, local_decision>;

/// CODM: centralised offloading decision making, at the provider; one
/// decision per requested service, in their order.
using central_policy = policy<central_context, std::vector<central_decision>>;

} // namespace sofof
