// What messages of release 2 have in common: its data dictionary.
// Source: ETSI TS 102 894-2 v2.2.1.
#pragma once

#include "messages/etsi/common.hpp"

namespace sofof::messages::etsi {

using identifier_1b = integer<0, 255>;
using identifier_2b = integer<0, 65535>;
using cardinal_number_1b = integer<0, 255>;
using confidence_level = integer<1, 101>; ///< %; 101 unavailable.
using sequence_of_identifier_1b = extensible_sequence_of<identifier_1b, 1, 128>;
/// ms since 2004-01-01T00:00:00Z, with leap seconds.
using timestamp_its = integer<0, 4'398'046'511'103>;
using delta_time = integer<-2048, 2047>; ///< ms

/// 1 radar, 2 lidar, 3 mono and 4 stereo camera, 5 night vision, 6 ultrasonic,
/// 7 time-of-flight camera, 8 induction loop, 9 spherical camera, 10 ultra
/// wide band, 11 acoustic, 12 fused here, 13 fused from messages.
using sensor_type = integer<0, 31>;

// Angles

inline constexpr std::uint16_t angle_unavailable = 3601;
using cartesian_angle_value = integer<0, angle_unavailable>; ///< 0.1 °, left

/// 0.1 °, from the x axis to the left.
using cartesian_angle =
    measured<"value", "confidence", cartesian_angle_value, narrow_confidence,
             angle_unavailable, confidence_unavailable>;
/// 0.1 °, clockwise from north.
using wgs84_angle = cartesian_angle;

struct euler_angles {
  cartesian_angle z; ///< Applied first, then y, then x.
  std::optional<cartesian_angle> y, x;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("zAngle", x.z);
    visit("yAngle", x.y);
    visit("xAngle", x.x);
  }
};

enum class angular_speed_confidence : std::uint8_t {
  within_1,
  within_2,
  within_5,
  within_10,
  within_20,
  within_50,
  out_of_range,
  unavailable,
};
template <>
inline constexpr auto names_of<angular_speed_confidence> =
    enumerated("degSec-01", "degSec-02", "degSec-05", "degSec-10", "degSec-20",
               "degSec-50", "outOfRange", "unavailable");
inline constexpr std::int16_t angular_velocity_unavailable = 256;
/// °/s, left positive.
using angular_velocity =
    measured<"value", "confidence", integer<-255, angular_velocity_unavailable>,
             angular_speed_confidence, angular_velocity_unavailable,
             angular_speed_confidence::unavailable>;

// Positions

using cartesian_coordinate = integer<-32'768, 32'767>;         ///< cm
using cartesian_coordinate_small = integer<-3094, 1001>;       ///< cm
using cartesian_coordinate_large = integer<-131'072, 131'071>; ///< cm
inline constexpr std::uint16_t coordinate_confidence_unavailable = 4096;

/// cm, both.
using measured_coordinate =
    measured<"value", "confidence", cartesian_coordinate_large,
             integer<1, coordinate_confidence_unavailable>, 0,
             coordinate_confidence_unavailable>;

struct cartesian_position {
  cartesian_coordinate x, y;
  std::optional<cartesian_coordinate> z;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("xCoordinate", x.x);
    visit("yCoordinate", x.y);
    visit("zCoordinate", x.z);
  }
};

struct measured_position {
  measured_coordinate x, y;
  std::optional<measured_coordinate> z;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("xCoordinate", x.x);
    visit("yCoordinate", x.y);
    visit("zCoordinate", x.z);
  }
};

// Motion

inline constexpr std::int16_t velocity_unavailable = 16'383;
/// cm/s, both.
using velocity_component =
    measured<"value", "confidence", integer<-16'383, velocity_unavailable>,
             narrow_confidence, velocity_unavailable, confidence_unavailable>;

struct polar_velocity {
  speed magnitude;
  cartesian_angle direction;
  std::optional<velocity_component> z;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("velocityMagnitude", x.magnitude);
    visit("velocityDirection", x.direction);
    visit("zVelocity", x.z);
  }
};

struct cartesian_velocity {
  velocity_component x, y;
  std::optional<velocity_component> z;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("xVelocity", x.x);
    visit("yVelocity", x.y);
    visit("zVelocity", x.z);
  }
};

using velocity = choice<alternative<"polarVelocity", polar_velocity>,
                        alternative<"cartesianVelocity", cartesian_velocity>>;

/// 0.1 m/s², both.
using acceleration_component =
    measured<"value", "confidence", acceleration_value, wide_confidence,
             acceleration_unavailable, wide_confidence_unavailable>;
/// 0.1 m/s², both.
using acceleration_magnitude =
    measured<"accelerationMagnitudeValue", "accelerationConfidence",
             integer<0, acceleration_unavailable>, wide_confidence,
             acceleration_unavailable, wide_confidence_unavailable>;

struct polar_acceleration {
  acceleration_magnitude magnitude;
  cartesian_angle direction;
  std::optional<acceleration_component> z;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("accelerationMagnitude", x.magnitude);
    visit("accelerationDirection", x.direction);
    visit("zAcceleration", x.z);
  }
};

struct cartesian_acceleration {
  acceleration_component x, y;
  std::optional<acceleration_component> z;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("xAcceleration", x.x);
    visit("yAcceleration", x.y);
    visit("zAcceleration", x.z);
  }
};

using acceleration =
    choice<alternative<"polarAcceleration", polar_acceleration>,
           alternative<"cartesianAcceleration", cartesian_acceleration>>;

// Shapes

using standard_length_12b = integer<0, 4095>; ///< 0.1 m

struct rectangular_shape {
  std::optional<cartesian_position> reference_point;
  standard_length_12b semi_length, semi_breadth;
  std::optional<cartesian_angle_value> orientation;
  std::optional<standard_length_12b> height;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("shapeReferencePoint", x.reference_point);
    visit("semiLength", x.semi_length);
    visit("semiBreadth", x.semi_breadth);
    visit("orientation", x.orientation);
    visit("height", x.height);
  }
};

struct circular_shape {
  std::optional<cartesian_position> reference_point;
  standard_length_12b radius;
  std::optional<standard_length_12b> height;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("shapeReferencePoint", x.reference_point);
    visit("radius", x.radius);
    visit("height", x.height);
  }
};

struct polygonal_shape {
  std::optional<cartesian_position> reference_point;
  extensible_sequence_of<cartesian_position, 3, 16> polygon;
  std::optional<standard_length_12b> height;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("shapeReferencePoint", x.reference_point);
    visit("polygon", x.polygon);
    visit("height", x.height);
  }
};

struct elliptical_shape {
  std::optional<cartesian_position> reference_point;
  standard_length_12b semi_major, semi_minor;
  std::optional<cartesian_angle_value> orientation;
  std::optional<standard_length_12b> height;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("shapeReferencePoint", x.reference_point);
    visit("semiMajorAxisLength", x.semi_major);
    visit("semiMinorAxisLength", x.semi_minor);
    visit("orientation", x.orientation);
    visit("height", x.height);
  }
};

struct radial_shape {
  std::optional<cartesian_position> reference_point;
  standard_length_12b range;
  cartesian_angle_value horizontal_start{angle_unavailable};
  cartesian_angle_value horizontal_end{angle_unavailable};
  std::optional<cartesian_angle_value> vertical_start, vertical_end;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("shapeReferencePoint", x.reference_point);
    visit("range", x.range);
    visit("horizontalOpeningAngleStart", x.horizontal_start);
    visit("horizontalOpeningAngleEnd", x.horizontal_end);
    visit("verticalOpeningAngleStart", x.vertical_start);
    visit("verticalOpeningAngleEnd", x.vertical_end);
  }
};

struct radial_shapes {
  struct details {
    standard_length_12b range;
    cartesian_angle_value horizontal_start{angle_unavailable};
    cartesian_angle_value horizontal_end{angle_unavailable};
    std::optional<cartesian_angle_value> vertical_start, vertical_end;

    static constexpr void fields(auto& x, auto&& visit) {
      visit("range", x.range);
      visit("horizontalOpeningAngleStart", x.horizontal_start);
      visit("horizontalOpeningAngleEnd", x.horizontal_end);
      visit("verticalOpeningAngleStart", x.vertical_start);
      visit("verticalOpeningAngleEnd", x.vertical_end);
    }
  };
  identifier_1b reference_point; ///< 0 of the station; else of a trailer.
  cartesian_coordinate_small x, y;
  std::optional<cartesian_coordinate_small> z;
  extensible_sequence_of<details, 1, 16> list;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("refPointId", x.reference_point);
    visit("xCoordinate", x.x);
    visit("yCoordinate", x.y);
    visit("zCoordinate", x.z);
    visit("radialShapesList", x.list);
  }
};

using shape = extensible_choice<alternative<"rectangular", rectangular_shape>,
                                alternative<"circular", circular_shape>,
                                alternative<"polygonal", polygonal_shape>,
                                alternative<"elliptical", elliptical_shape>,
                                alternative<"radial", radial_shape>,
                                alternative<"radialShapes", radial_shapes>>;

// Maps

/// A road segment or an intersection as a MAPEM names it.
struct map_element_id {
  std::optional<identifier_2b> region;
  identifier_2b id;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("region", x.region);
    visit("id", x.id);
  }
};
using map_reference = choice<alternative<"roadsegment", map_element_id>,
                             alternative<"intersection", map_element_id>>;

struct map_position {
  static constexpr auto may_grow = extensible;
  static constexpr std::uint16_t position_unavailable = 32'767;
  static constexpr std::uint16_t confidence_unavailable = 1023;
  /// 0.1 m, both.
  using along_lane = measured<
      "longitudinalLanePositionValue", "longitudinalLanePositionConfidence",
      integer<0, position_unavailable>, integer<0, confidence_unavailable>,
      position_unavailable, confidence_unavailable>;
  std::optional<etsi::map_reference> map_reference;
  std::optional<identifier_1b> lane, connection; ///< One of them.
  std::optional<along_lane> position;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("mapReference", x.map_reference);
    visit("laneId", x.lane);
    visit("connectionId", x.connection);
    visit("longitudinalLanePosition", x.position);
  }
};

// Vulnerable road users

using vru_sub_profile = integer<0, 15>;
/// Pedestrian: 1 ordinary, 2 road worker, 3 first responder. Bicyclist: 1 on a
/// bicycle, 2 in a wheelchair, 3 on a horse, 4 on skates, 5 on a scooter, 6 on
/// a personal transporter, 7 on a pedelec, 8 on a fast one. Motorcyclist: 1 on
/// a moped, 2 on a motorcycle, 3 and 4 with a sidecar to the right or left.
/// Animal: 1 wild, 2 of a farm, 3 in service. Each: 0 unavailable.
using vru_profile = extensible_choice<
    alternative<"pedestrian", vru_sub_profile>,
    alternative<"bicyclistAndLightVruVehicle", vru_sub_profile>,
    alternative<"motorcyclist", vru_sub_profile>,
    alternative<"animal", vru_sub_profile>>;

struct vru_cluster {
  static constexpr auto may_grow = extensible;
  std::optional<identifier_1b> id;
  std::optional<shape> bounding_box; ///< Not in a CPM.
  cardinal_number_1b size;
  /// Bits: pedestrian, bicyclist, motorcyclist, animal.
  std::optional<bit_string<4>> profiles;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("clusterId", x.id);
    visit("clusterBoundingBoxShape", x.bounding_box);
    visit("clusterCardinalitySize", x.size);
    visit("clusterProfiles", x.profiles);
  }
};

// Trailers

struct trailer_data {
  static constexpr auto may_grow = extensible;
  using length = integer<0, 255>; ///< 0.1 m
  identifier_1b reference_point;
  length hitch_point_offset;
  std::optional<length> front_overhang, rear_overhang; ///< Not in a CPM.
  std::optional<vehicle_width> width;                  ///< Not in a CPM.
  cartesian_angle hitch_angle;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("refPointId", x.reference_point);
    visit("hitchPointOffset", x.hitch_point_offset);
    visit("frontOverhang", x.front_overhang);
    visit("rearOverhang", x.rear_overhang);
    visit("trailerWidth", x.width);
    visit("hitchAngle", x.hitch_angle);
  }
};

} // namespace sofof::messages::etsi
