// Maneuver Coordination Message: what a road user plans and wishes, and what a
// coordinator suggests to it.
// Source: Mertens et al., "An Extended Maneuver Coordination Protocol with
// Support for Urban Scenarios and Mixed Traffic", IEEE VNC 2021; encoded as
// the MCM of the LUKAS project. Not the MCM of ETSI TS 103 561.
#pragma once

#include "messages/etsi/common_release2.hpp"

namespace sofof::messages::etsi {

// -- places and times ---------------------------------------------------------

/// A confidence ellipse with the names of release 2 (TS 102 894-2 v2.1.1).
struct confidence_ellipse_2 : confidence_ellipse {
  static constexpr void fields(auto& x, auto&& visit) {
    visit("semiMajorAxisLength", x.semi_major);
    visit("semiMinorAxisLength", x.semi_minor);
    visit("semiMajorAxisOrientation", x.orientation);
  }
};

struct reference_position_with_confidence {
  etsi::latitude latitude{latitude_unavailable};
  etsi::longitude longitude{longitude_unavailable};
  confidence_ellipse_2 confidence;
  etsi::altitude altitude;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("latitude", x.latitude);
    visit("longitude", x.longitude);
    visit("positionConfidenceEllipse", x.confidence);
    visit("altitude", x.altitude);
  }
};

/// The longest list of points or road users.
inline constexpr std::size_t most_waypoints = 128;

using waypoint_delta_time = integer<0, 65535>; ///< ms

/// A place seen from the reference position, which the ASN.1 leaves open: here
/// x points east and y north, in cm, up to ±131071.
struct waypoint {
  cartesian_coordinate_large x, y;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("xDistance", x.x);
    visit("yDistance", x.y);
  }
};

template <class T>
using waypoints_of = extensible_sequence_of<T, 1, most_waypoints>;

// -- from a road user ---------------------------------------------------------

inline constexpr std::uint8_t road_user_size_unavailable = 62;
using road_user_size = integer<1, road_user_size_unavailable>; ///< 0.1 m

enum class road_user_type : std::uint8_t {
  connected_vehicle,
  connected_automated_vehicle,
  connected_cyclist,
  connected_pedestrian,
  connected_road_sweeper,
  connected_collection_vehicle,
};
template <>
inline constexpr auto names_of<road_user_type> =
    enumerated_extensible("connectedVehicle", "connectedAutomatedVehicle",
                          "connectedCyclist", "connectedPedestrian",
                          "connectedRoadSweeper", "connectedCollectionVehicle");

struct road_user_state {
  road_user_type type = road_user_type::connected_vehicle;
  speed_value speed{speed_unavailable};
  heading_value heading{heading_unavailable};
  road_user_size length{road_user_size_unavailable};
  road_user_size width{road_user_size_unavailable};

  static constexpr void fields(auto& x, auto&& visit) {
    visit("roadUserType", x.type);
    visit("speed", x.speed);
    visit("heading", x.heading);
    visit("length", x.length);
    visit("width", x.width);
  }
};

struct trajectory_point {
  etsi::waypoint waypoint;
  speed_value speed{speed_unavailable};
  heading_value heading{heading_unavailable};

  static constexpr void fields(auto& x, auto&& visit) {
    visit("waypoint", x.waypoint);
    visit("speed", x.speed);
    visit("heading", x.heading);
  }
};

/// Points at equal distances in time.
struct planned_trajectory {
  integer<0, 65535> start_delta_time; ///< ms, from generationDeltaTime.
  integer<1, 255> delta_time;         ///< ms
  waypoints_of<trajectory_point> points;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("startDeltaTime", x.start_delta_time);
    visit("deltaTime", x.delta_time);
    visit("trajectoryPointContainer", x.points);
  }
};

using desired_route = waypoints_of<waypoint>;
using maneuver_id = integer<0, 65535>;
using advice_update_id = integer<0, 65535>;

enum class maneuver_response : std::uint8_t { accept, reject, pending };
template <>
inline constexpr auto
    names_of<maneuver_response> = enumerated("accept", "reject", "pending");

struct advice_response {
  etsi::maneuver_id maneuver_id;
  etsi::advice_update_id advice_update_id;
  maneuver_response followed = maneuver_response::accept;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("maneuverID", x.maneuver_id);
    visit("adviceUpdateID", x.advice_update_id);
    visit("adviceFollowed", x.followed);
  }
};

struct road_user_container {
  road_user_state state;
  std::optional<etsi::planned_trajectory> planned_trajectory;
  std::optional<etsi::desired_route> desired_route;
  std::optional<etsi::advice_response> advice_response;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("roadUserState", x.state);
    visit("plannedTrajectory", x.planned_trajectory);
    visit("desiredRoute", x.desired_route);
    visit("adviceResponse", x.advice_response);
  }
};

// -- from a coordinator -------------------------------------------------------

/// Which of the participating road users.
using road_user_index = integer<0, 127>;

/// When to be where, how fast, and behind whom.
struct longitudinal_waypoint {
  etsi::waypoint waypoint;
  waypoint_delta_time min_arrival_time, max_arrival_time; ///< ms
  std::optional<speed_value> min_velocity, max_velocity;  ///< cm/s
  std::optional<waypoint_delta_time> min_duration_of_stop;
  std::optional<road_user_index> preceding, following;
  std::optional<extensible_sequence_of<road_user_index, 1, 16>> yield_to;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("waypoint", x.waypoint);
    visit("minArrivalTime", x.min_arrival_time);
    visit("maxArrivalTime", x.max_arrival_time);
    visit("minVelocity", x.min_velocity);
    visit("maxVelocity", x.max_velocity);
    visit("minDurationOfStop", x.min_duration_of_stop);
    visit("precedingRoadUser", x.preceding);
    visit("followingRoadUser", x.following);
    visit("yieldToRoadUserContainer", x.yield_to);
  }
};

enum class maneuver_type : std::uint8_t {
  free_travel,
  follow_road_user,
  cross_intersection,
  yield_at_intersection,
  overtake,
  pull_over,
  yield_at_obstacle,
  unknown,
};
template <>
inline constexpr auto names_of<maneuver_type> = enumerated(
    "freeTravel", "followRoadUser", "crossIntersection", "yieldAtIntersection",
    "overtake", "pullOver", "yieldAtObstacle", "maneuverTypeUnknown");

struct maneuver_constraints {
  std::optional<maneuver_type> type;
  waypoints_of<longitudinal_waypoint> waypoints;
  std::optional<waypoints_of<waypoint>> corridor; ///< A polygon.

  static constexpr void fields(auto& x, auto&& visit) {
    visit("maneuverType", x.type);
    visit("longitudinalManeuverWaypointContainer", x.waypoints);
    visit("maneuverCorridor", x.corridor);
  }
};

enum class termination_status : std::uint8_t {
  regular_end,
  abort_by_reject,
  abort_by_timeout,
  abort_by_constraint_violation,
  abort_by_emergency_vehicle_appearance,
  reason_unknown,
};
template <>
inline constexpr auto names_of<termination_status> =
    enumerated("regularEnd", "abortByReject", "abortByTimeout",
               "abortByConstraintViolation",
               "abortByEmergencyVehicleAppearance", "reasonUnknown");

struct suggested_maneuver {
  using parameters_type =
      choice<alternative<"maneuverConstraints", maneuver_constraints>,
             alternative<"terminationStatus", termination_status>>;

  etsi::maneuver_id maneuver_id;
  etsi::advice_update_id advice_update_id;
  waypoints_of<station_id> participants;
  bool confirmation_required = false;
  parameters_type parameters;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("maneuverID", x.maneuver_id);
    visit("adviceUpdateID", x.advice_update_id);
    visit("participatingRoadUserIDContainer", x.participants);
    visit("confirmationRequiredFlag", x.confirmation_required);
    visit("maneuverParameters", x.parameters);
  }
};

struct suggested_maneuver_container {
  station_id target;
  std::optional<suggested_maneuver> maneuver;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("targetStationID", x.target);
    visit("suggestedManeuver", x.maneuver);
  }
};

// -- the message --------------------------------------------------------------

struct mcm {
  static constexpr std::uint8_t protocol_version = 2;
  static constexpr std::uint8_t message_id = 20;

  using maneuver_container = choice<
      alternative<"roadUserContainer", road_user_container>,
      alternative<"suggestedManeuverContainer", suggested_maneuver_container>>;

  struct basic_container {
    static constexpr auto may_grow = extensible;
    etsi::station_type station_type;
    reference_position_with_confidence position;

    static constexpr void fields(auto& x, auto&& visit) {
      visit("stationType", x.station_type);
      visit("referencePosition", x.position);
    }
  };

  struct parameters {
    basic_container basic;
    mcm::maneuver_container maneuver;

    static constexpr void fields(auto& x, auto&& visit) {
      visit("basicContainer", x.basic);
      visit("maneuverContainer", x.maneuver);
    }
  };

  struct coordination {
    generation_delta_time generation;
    mcm::parameters parameters;

    static constexpr void fields(auto& x, auto&& visit) {
      visit("generationDeltaTime", x.generation);
      visit("mcmParameters", x.parameters);
    }
  };

  pdu_header_2 header{{protocol_version, message_id, {}}};
  coordination body;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("header", x.header);
    visit("mcm", x.body);
  }
};

} // namespace sofof::messages::etsi
