// Cooperative Awareness Message: where a station is and how it moves.
// Source: ETSI EN 302 637-2 v1.4.1.
#pragma once

#include "messages/etsi/common.hpp"

namespace sofof::messages::etsi {

// -- high frequency: in every CAM ---------------------------------------------

/// 1.5 °, left positive.
using steering_wheel_angle =
    measured<"steeringWheelAngleValue", "steeringWheelAngleConfidence",
             integer<-511, 512>, narrow_confidence, 512,
             confidence_unavailable>;

using zone_id = integer<0, 134'217'727>;

struct tolling_zone {
  static constexpr auto may_grow = extensible;
  etsi::latitude latitude{latitude_unavailable};
  etsi::longitude longitude{longitude_unavailable};
  std::optional<zone_id> id;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("protectedZoneLatitude", x.latitude);
    visit("protectedZoneLongitude", x.longitude);
    visit("cenDsrcTollingZoneID", x.id);
  }
};

/// Bits: brake, gas, emergency brake, collision warning, adaptive cruise
/// control, cruise control, speed limiter.
using acceleration_control = bit_string<7>;

struct vehicle_high_frequency {
  etsi::heading heading;
  etsi::speed speed;
  etsi::drive_direction drive_direction = drive_direction::unavailable;
  vehicle_length length;
  vehicle_width width{vehicle_width_unavailable};
  longitudinal_acceleration acceleration;
  etsi::curvature curvature;
  curvature_calculation_mode curvature_mode =
      curvature_calculation_mode::unavailable;
  etsi::yaw_rate yaw_rate;
  std::optional<acceleration_control> control;
  std::optional<integer<-1, 14>> lane_position;
  std::optional<steering_wheel_angle> steering;
  std::optional<etsi::lateral_acceleration> lateral_acceleration;
  std::optional<etsi::vertical_acceleration> vertical_acceleration;
  std::optional<integer<0, 7>> performance_class;
  std::optional<tolling_zone> tolling;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("heading", x.heading);
    visit("speed", x.speed);
    visit("driveDirection", x.drive_direction);
    visit("vehicleLength", x.length);
    visit("vehicleWidth", x.width);
    visit("longitudinalAcceleration", x.acceleration);
    visit("curvature", x.curvature);
    visit("curvatureCalculationMode", x.curvature_mode);
    visit("yawRate", x.yaw_rate);
    visit("accelerationControl", x.control);
    visit("lanePosition", x.lane_position);
    visit("steeringWheelAngle", x.steering);
    visit("lateralAcceleration", x.lateral_acceleration);
    visit("verticalAcceleration", x.vertical_acceleration);
    visit("performanceClass", x.performance_class);
    visit("cenDsrcTollingZone", x.tolling);
  }
};

enum class protected_zone : std::uint8_t { permanent_tolling };
template <>
inline constexpr auto
    names_of<protected_zone> = enumerated_extensible("permanentCenDsrcTolling");

struct communication_zone {
  static constexpr auto may_grow = extensible;
  protected_zone type = protected_zone::permanent_tolling;
  std::optional<integer<0, 4'398'046'511'103>> expiry_time; ///< TimestampIts
  etsi::latitude latitude{latitude_unavailable};
  etsi::longitude longitude{longitude_unavailable};
  std::optional<extensible_integer<1, 255>> radius; ///< m
  std::optional<zone_id> id;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("protectedZoneType", x.type);
    visit("expiryTime", x.expiry_time);
    visit("protectedZoneLatitude", x.latitude);
    visit("protectedZoneLongitude", x.longitude);
    visit("protectedZoneRadius", x.radius);
    visit("protectedZoneID", x.id);
  }
};

struct roadside_high_frequency {
  static constexpr auto may_grow = extensible;
  std::optional<sequence_of<communication_zone, 1, 16>> zones;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("protectedCommunicationZonesRSU", x.zones);
  }
};

// -- low frequency: now and then ---------------------------------------------

enum class vehicle_role : std::uint8_t {
  standard,
  public_transport,
  special_transport,
  dangerous_goods,
  road_work,
  rescue,
  emergency,
  safety_car,
  agriculture,
  commercial,
  military,
  road_operator,
  taxi,
  reserved_1,
  reserved_2,
  reserved_3,
};
template <>
inline constexpr auto names_of<vehicle_role> = enumerated(
    "default", "publicTransport", "specialTransport", "dangerousGoods",
    "roadWork", "rescue", "emergency", "safetyCar", "agriculture", "commercial",
    "military", "roadOperator", "taxi", "reserved1", "reserved2", "reserved3");

inline constexpr std::int32_t delta_degrees_unavailable = 131'072;
inline constexpr std::int16_t delta_altitude_unavailable = 12'800;

struct path_point {
  using delta_degrees = integer<-131'071, delta_degrees_unavailable>;
  struct position {
    delta_degrees latitude{delta_degrees_unavailable};  ///< 1e-7 °
    delta_degrees longitude{delta_degrees_unavailable}; ///< 1e-7 °
    integer<-12'700, delta_altitude_unavailable> altitude{
        delta_altitude_unavailable}; ///< cm

    static constexpr void fields(auto& x, auto&& visit) {
      visit("deltaLatitude", x.latitude);
      visit("deltaLongitude", x.longitude);
      visit("deltaAltitude", x.altitude);
    }
  };
  path_point::position position; ///< From the newer point, or the sender.
  /// Since then until the newer point, 10 ms.
  std::optional<extensible_integer<1, 65535>> before;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("pathPosition", x.position);
    visit("pathDeltaTime", x.before);
  }
};

struct vehicle_low_frequency {
  vehicle_role role = vehicle_role::standard;
  /// Bits: low beam, high beam, left, right, daytime, reverse, fog, parking.
  bit_string<8> lights;
  sequence_of<path_point, 0, 40> path_history; ///< Newest first.

  static constexpr void fields(auto& x, auto&& visit) {
    visit("vehicleRole", x.role);
    visit("exteriorLights", x.lights);
    visit("pathHistory", x.path_history);
  }
};

// -- special vehicles
// ----------------------------------------------------------

using light_bar_siren = bit_string<2>;

struct cause_code {
  static constexpr auto may_grow = extensible;
  integer<0, 255> cause, sub_cause;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("causeCode", x.cause);
    visit("subCauseCode", x.sub_cause);
  }
};

struct public_transport {
  struct activation {
    integer<0, 255> type;
    sequence_of<integer<0, 255>, 1, 20> data;

    static constexpr void fields(auto& x, auto&& visit) {
      visit("ptActivationType", x.type);
      visit("ptActivationData", x.data);
    }
  };
  bool embarkation = false;
  std::optional<public_transport::activation> activation;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("embarkationStatus", x.embarkation);
    visit("ptActivation", x.activation);
  }
};

struct special_transport {
  bit_string<4> type;
  light_bar_siren in_use;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("specialTransportType", x.type);
    visit("lightBarSirenInUse", x.in_use);
  }
};

enum class dangerous_goods_basic : std::uint8_t { explosives_1 };
template <>
inline constexpr auto names_of<dangerous_goods_basic> =
    enumerated("explosives1", "explosives2", "explosives3", "explosives4",
               "explosives5", "explosives6", "flammableGases",
               "nonFlammableGases", "toxicGases", "flammableLiquids",
               "flammableSolids", "substancesLiableToSpontaneousCombustion",
               "substancesEmittingFlammableGasesUponContactWithWater",
               "oxidizingSubstances", "organicPeroxides", "toxicSubstances",
               "infectiousSubstances", "radioactiveMaterial",
               "corrosiveSubstances", "miscellaneousDangerousSubstances");

struct dangerous_goods {
  dangerous_goods_basic goods = dangerous_goods_basic::explosives_1;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("dangerousGoodsBasic", x.goods);
  }
};

enum class hard_shoulder : std::uint8_t { for_stopping, closed, for_driving };
template <>
inline constexpr auto names_of<hard_shoulder> =
    enumerated("availableForStopping", "closed", "availableForDriving");

struct closed_lanes {
  static constexpr auto may_grow = extensible;
  std::optional<hard_shoulder> inner, outer;
  std::optional<sequence_of<bool, 1, 13>> lanes; ///< As a BIT STRING.

  static constexpr void fields(auto& x, auto&& visit) {
    visit("innerhardShoulderStatus", x.inner);
    visit("outerhardShoulderStatus", x.outer);
    visit("drivingLaneStatus", x.lanes);
  }
};

struct road_works {
  std::optional<integer<0, 255>> sub_cause;
  light_bar_siren in_use;
  std::optional<etsi::closed_lanes> closed_lanes;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("roadworksSubCauseCode", x.sub_cause);
    visit("lightBarSirenInUse", x.in_use);
    visit("closedLanes", x.closed_lanes);
  }
};

struct rescue {
  light_bar_siren in_use;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("lightBarSirenInUse", x.in_use);
  }
};

struct emergency {
  light_bar_siren in_use;
  std::optional<cause_code> incident;
  std::optional<bit_string<2>> priority;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("lightBarSirenInUse", x.in_use);
    visit("incidentIndication", x.incident);
    visit("emergencyPriority", x.priority);
  }
};

enum class traffic_rule : std::uint8_t {
  no_passing,
  no_passing_for_trucks,
  pass_to_right,
  pass_to_left,
};
template <>
inline constexpr auto names_of<traffic_rule> = enumerated_extensible(
    "noPassing", "noPassingForTrucks", "passToRight", "passToLeft");

struct safety_car {
  light_bar_siren in_use;
  std::optional<cause_code> incident;
  std::optional<traffic_rule> rule;
  std::optional<integer<1, 255>> speed_limit; ///< km/h

  static constexpr void fields(auto& x, auto&& visit) {
    visit("lightBarSirenInUse", x.in_use);
    visit("incidentIndication", x.incident);
    visit("trafficRule", x.rule);
    visit("speedLimit", x.speed_limit);
  }
};

// -- the message
// -----------------------------------------------------------------

struct cam {
  static constexpr std::uint8_t protocol_version = 2;
  static constexpr std::uint8_t message_id = 2;

  using high_frequency = extensible_choice<
      alternative<"basicVehicleContainerHighFrequency", vehicle_high_frequency>,
      alternative<"rsuContainerHighFrequency", roadside_high_frequency>>;
  using low_frequency = extensible_choice<
      alternative<"basicVehicleContainerLowFrequency", vehicle_low_frequency>>;
  using special = extensible_choice<
      alternative<"publicTransportContainer", public_transport>,
      alternative<"specialTransportContainer", special_transport>,
      alternative<"dangerousGoodsContainer", dangerous_goods>,
      alternative<"roadWorksContainerBasic", road_works>,
      alternative<"rescueContainer", rescue>,
      alternative<"emergencyContainer", emergency>,
      alternative<"safetyCarContainer", safety_car>>;

  struct basic_container {
    static constexpr auto may_grow = extensible;
    etsi::station_type station_type;
    reference_position position;

    static constexpr void fields(auto& x, auto&& visit) {
      visit("stationType", x.station_type);
      visit("referencePosition", x.position);
    }
  };

  struct parameters {
    static constexpr auto may_grow = extensible;
    basic_container basic;
    cam::high_frequency high_frequency;
    std::optional<cam::low_frequency> low_frequency;
    std::optional<cam::special> special;

    static constexpr void fields(auto& x, auto&& visit) {
      visit("basicContainer", x.basic);
      visit("highFrequencyContainer", x.high_frequency);
      visit("lowFrequencyContainer", x.low_frequency);
      visit("specialVehicleContainer", x.special);
    }
  };

  struct awareness {
    /// Of the time when the position held.
    generation_delta_time generation;
    cam::parameters parameters;

    static constexpr void fields(auto& x, auto&& visit) {
      visit("generationDeltaTime", x.generation);
      visit("camParameters", x.parameters);
    }
  };

  pdu_header header{protocol_version, message_id, {}};
  awareness body;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("header", x.header);
    visit("cam", x.body);
  }
};

} // namespace sofof::messages::etsi
