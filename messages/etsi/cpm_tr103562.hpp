// Collective Perception Message: what a station sees, and with which sensors.
// Source: ETSI TR 103 562 v2.1.1, with ISO/TS 19091 for points and lanes.
#pragma once

#include "messages/etsi/common.hpp"

namespace sofof::messages::etsi::tr103562 {

// -- numbers and pairs that recur ---------------------------------------------

using identifier = integer<0, 255>;
using sensor_id_list = extensible_sequence_of<identifier, 1, 128>;
using percentage = integer<0, 101>; ///< 0 unknown, 101 unavailable.
using range = integer<0, 10'000>;   ///< 0.1 m
using angle_value = integer<0, heading_unavailable>; ///< 0.1 °
inline constexpr std::int16_t speed_extended_unavailable = 16'383;

/// 0.1 °.
using angle = measured<"value", "confidence", angle_value, narrow_confidence,
                       heading_unavailable, confidence_unavailable>;
/// cm, both.
using distance = measured<"value", "confidence", integer<-132'768, 132'767>,
                          wide_confidence, 0, wide_confidence_unavailable>;
/// cm/s, both.
using speed_extended =
    measured<"value", "confidence", integer<-16'383, 16'383>, narrow_confidence,
             speed_extended_unavailable, confidence_unavailable>;
/// 0.1 m; its confidence in cm.
using dimension = measured<"value", "confidence", integer<0, 1023>,
                           wide_confidence, 0, wide_confidence_unavailable>;

// -- areas --------------------------------------------------------------------

template <unsigned bits>
using offset = integer<-(std::int64_t{1} << (bits - 1)),
                       (std::int64_t{1} << (bits - 1)) - 1>; ///< cm

template <unsigned bits>
struct node_xy {
  offset<bits> x, y;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("x", x.x);
    visit("y", x.y);
  }
};

/// From the reference position. What ISO/TS 19091 has besides, places on the
/// globe and regional ones, a CPM must not have.
struct offset_point {
  using node_z = choice<
      alternative<"node-Z1", offset<10>>, alternative<"node-Z2", offset<11>>,
      alternative<"node-Z3", offset<12>>, alternative<"node-Z4", offset<13>>,
      alternative<"node-Z5", offset<14>>, alternative<"node-Z6", offset<16>>>;

  choice<alternative<"node-XY1", node_xy<10>>,
         alternative<"node-XY2", node_xy<11>>,
         alternative<"node-XY3", node_xy<12>>,
         alternative<"node-XY4", node_xy<13>>,
         alternative<"node-XY5", node_xy<14>>,
         alternative<"node-XY6", node_xy<16>>>
      xy;
  std::optional<node_z> z;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("nodeOffsetPointxy", x.xy);
    visit("nodeOffsetPointZ", x.z);
  }
};

struct area_polygon {
  extensible_sequence_of<offset_point, 3, 16> points;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("polyPointList", x.points);
  }
};

struct area_circular {
  std::optional<offset_point> center;
  range radius;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("nodeCenterPoint", x.center);
    visit("radius", x.radius);
  }
};

struct area_ellipse {
  std::optional<offset_point> center;
  range semi_minor, semi_major;
  angle_value orientation{heading_unavailable};
  std::optional<range> semi_height;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("nodeCenterPoint", x.center);
    visit("semiMinorRangeLength", x.semi_minor);
    visit("semiMajorRangeLength", x.semi_major);
    visit("semiMajorRangeOrientation", x.orientation);
    visit("semiHeight", x.semi_height);
  }
};

struct area_rectangle {
  std::optional<offset_point> center;
  range semi_major, semi_minor;
  angle_value orientation{heading_unavailable};
  std::optional<range> semi_height;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("nodeCenterPoint", x.center);
    visit("semiMajorRangeLength", x.semi_major);
    visit("semiMinorRangeLength", x.semi_minor);
    visit("semiMajorRangeOrientation", x.orientation);
    visit("semiHeight", x.semi_height);
  }
};

struct area_radial {
  static constexpr auto may_grow = extensible;
  tr103562::range range;
  angle_value horizontal_start{heading_unavailable};
  angle_value horizontal_end{heading_unavailable};
  std::optional<angle_value> vertical_start, vertical_end;
  std::optional<offset_point> position;
  std::optional<integer<-5000, 5000>> height; ///< cm

  static constexpr void fields(auto& x, auto&& visit) {
    visit("range", x.range);
    visit("stationaryHorizontalOpeningAngleStart", x.horizontal_start);
    visit("stationaryHorizontalOpeningAngleEnd", x.horizontal_end);
    visit("verticalOpeningAngleStart", x.vertical_start);
    visit("verticalOpeningAngleEnd", x.vertical_end);
    visit("sensorPositionOffset", x.position);
    visit("sensorHeight", x.height);
  }
};

// -- sensors ------------------------------------------------------------------

struct vehicle_sensor {
  static constexpr auto may_grow = extensible;
  struct properties {
    static constexpr auto may_grow = extensible;
    tr103562::range range;
    angle_value horizontal_start{heading_unavailable};
    angle_value horizontal_end{heading_unavailable};
    std::optional<angle_value> vertical_start, vertical_end;

    static constexpr void fields(auto& x, auto&& visit) {
      visit("range", x.range);
      visit("horizontalOpeningAngleStart", x.horizontal_start);
      visit("horizontalOpeningAngleEnd", x.horizontal_end);
      visit("verticalOpeningAngleStart", x.vertical_start);
      visit("verticalOpeningAngleEnd", x.vertical_end);
    }
  };
  defaulted<identifier, 0> reference_point;
  integer<-5000, 0> x;               ///< cm
  integer<-1000, 1000> y;            ///< cm
  std::optional<integer<0, 1000>> z; ///< cm
  sequence_of<vehicle_sensor::properties, 1, 10> properties;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("refPointId", x.reference_point);
    visit("xSensorOffset", x.x);
    visit("ySensorOffset", x.y);
    visit("zSensorOffset", x.z);
    visit("vehicleSensorPropertyList", x.properties);
  }
};

struct sensor_information {
  static constexpr auto may_grow = extensible;
  using area = extensible_choice<
      alternative<"vehicleSensor", vehicle_sensor>,
      alternative<"stationarySensorRadial", area_radial>,
      alternative<"stationarySensorPolygon", area_polygon>,
      alternative<"stationarySensorCircular", area_circular>,
      alternative<"stationarySensorEllipse", area_ellipse>,
      alternative<"stationarySensorRectangle", area_rectangle>>;
  identifier id;
  /// 1 radar, 2 lidar, 3 mono and 4 stereo camera, 5 night vision,
  /// 6 ultrasonic, 7 time-of-flight camera, 8 fusion, 9 induction loop,
  /// 10 spherical camera, 11 other stations' messages.
  integer<0, 15> type;
  area detection_area;
  std::optional<percentage> free_space_confidence;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("sensorID", x.id);
    visit("type", x.type);
    visit("detectionArea", x.detection_area);
    visit("freeSpaceConfidence", x.free_space_confidence);
  }
};

struct free_space_addendum {
  static constexpr auto may_grow = extensible;
  percentage confidence;
  extensible_choice<alternative<"freeSpacePolygon", area_polygon>,
                    alternative<"freeSpaceCircular", area_circular>,
                    alternative<"freeSpaceEllipse", area_ellipse>,
                    alternative<"freeSpaceRectangle", area_rectangle>>
      area;
  std::optional<sensor_id_list> sensors;
  defaulted<bool, true> shadowing;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("freeSpaceConfidence", x.confidence);
    visit("freeSpaceArea", x.area);
    visit("sensorIDList", x.sensors);
    visit("shadowingApplies", x.shadowing);
  }
};

// -- perceived objects --------------------------------------------------------

struct object_class {
  struct subclass {
    /// Vehicle: 1 moped, 2 motorcycle, 3 car, 4 bus, 5 and 6 light and heavy
    /// truck, 7 trailer, 8 special, 9 tram, 10 emergency, 11 agricultural.
    /// Person: 1 pedestrian, 2 in a wheelchair, 3 cyclist, 4 with a stroller,
    /// 5 on skates, 6 group. Other: 1 roadside unit. Each: 0 unknown.
    defaulted<integer<0, 255>, 0> type;
    defaulted<percentage, 0> confidence;

    static constexpr void fields(auto& x, auto&& visit) {
      visit("type", x.type);
      visit("confidence", x.confidence);
    }
  };
  percentage confidence;
  choice<alternative<"vehicle", subclass>, alternative<"person", subclass>,
         alternative<"animal", subclass>, alternative<"other", subclass>>
      what;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("confidence", x.confidence);
    visit("class", x.what);
  }
};

struct matched_position {
  static constexpr auto may_grow = extensible;
  /// 0.1 m; its confidence in cm.
  using along_lane =
      measured<"longitudinalLanePositionValue",
               "longitudinalLanePositionConfidence", integer<0, 32'767>,
               wide_confidence, 0, wide_confidence_unavailable>;
  std::optional<integer<0, 255>> lane;
  std::optional<along_lane> position;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("laneID", x.lane);
    visit("longitudinalLanePosition", x.position);
  }
};

/// Something that is perceived. In the frame of the sender: from its reference
/// position, x where a vehicle is heading, y to its left, z up.
struct perceived_object {
  static constexpr auto may_grow = extensible;
  identifier id;
  std::optional<sensor_id_list> sensors;
  integer<-1500, 1500> time_of_measurement; ///< ms
  std::optional<integer<0, 1500>> age;      ///< ms
  defaulted<percentage, 0> confidence;
  distance x_distance, y_distance; ///< Of the object's reference point.
  std::optional<distance> z_distance;
  speed_extended x_speed, y_speed;
  std::optional<speed_extended> z_speed;
  std::optional<longitudinal_acceleration> x_acceleration;
  std::optional<lateral_acceleration> y_acceleration;
  std::optional<vertical_acceleration> z_acceleration;
  std::optional<angle> yaw;
  std::optional<dimension> planar_dimension_1, planar_dimension_2;
  std::optional<dimension> vertical_dimension;
  /// 0 its middle; 1 to 8 the middles of its sides and its corners.
  defaulted<integer<0, 8>, 0> reference_point;
  /// 0 moving, 1 has been moving, 2 static.
  std::optional<integer<0, 2>> dynamic_status;
  std::optional<sequence_of<object_class, 1, 8>> classification;
  std::optional<tr103562::matched_position> matched_position;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("objectID", x.id);
    visit("sensorIDList", x.sensors);
    visit("timeOfMeasurement", x.time_of_measurement);
    visit("objectAge", x.age);
    visit("objectConfidence", x.confidence);
    visit("xDistance", x.x_distance);
    visit("yDistance", x.y_distance);
    visit("zDistance", x.z_distance);
    visit("xSpeed", x.x_speed);
    visit("ySpeed", x.y_speed);
    visit("zSpeed", x.z_speed);
    visit("xAcceleration", x.x_acceleration);
    visit("yAcceleration", x.y_acceleration);
    visit("zAcceleration", x.z_acceleration);
    visit("yawAngle", x.yaw);
    visit("planarObjectDimension1", x.planar_dimension_1);
    visit("planarObjectDimension2", x.planar_dimension_2);
    visit("verticalObjectDimension", x.vertical_dimension);
    visit("objectRefPoint", x.reference_point);
    visit("dynamicStatus", x.dynamic_status);
    visit("classification", x.classification);
    visit("matchedPosition", x.matched_position);
  }
};

// -- the sender ---------------------------------------------------------------

struct trailer {
  static constexpr auto may_grow = extensible;
  identifier reference_point;
  integer<0, 100> hitch_point;   ///< 0.1 m
  integer<0, 50> front_overhang; ///< 0.1 m
  integer<0, 150> rear_overhang; ///< 0.1 m
  std::optional<vehicle_width> width;
  std::optional<angle> hitch_angle;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("refPointId", x.reference_point);
    visit("hitchPointOffset", x.hitch_point);
    visit("frontOverhang", x.front_overhang);
    visit("rearOverhang", x.rear_overhang);
    visit("trailerWidth", x.width);
    visit("hitchAngle", x.hitch_angle);
  }
};

struct originating_vehicle {
  static constexpr auto may_grow = extensible;
  etsi::heading heading; ///< Of its motion.
  etsi::speed speed;
  std::optional<angle> orientation; ///< Of its body, from north.
  defaulted<etsi::drive_direction, etsi::drive_direction::forward>
      drive_direction;
  std::optional<etsi::longitudinal_acceleration> longitudinal_acceleration;
  std::optional<etsi::lateral_acceleration> lateral_acceleration;
  std::optional<etsi::vertical_acceleration> vertical_acceleration;
  std::optional<etsi::yaw_rate> yaw_rate;
  std::optional<angle> pitch, roll;
  std::optional<vehicle_length> length;
  std::optional<vehicle_width> width;
  std::optional<integer<0, 127>> height; ///< 5 cm
  std::optional<sequence_of<trailer, 1, 2>> trailers;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("heading", x.heading);
    visit("speed", x.speed);
    visit("vehicleOrientationAngle", x.orientation);
    visit("driveDirection", x.drive_direction);
    visit("longitudinalAcceleration", x.longitudinal_acceleration);
    visit("lateralAcceleration", x.lateral_acceleration);
    visit("verticalAcceleration", x.vertical_acceleration);
    visit("yawRate", x.yaw_rate);
    visit("pitchAngle", x.pitch);
    visit("rollAngle", x.roll);
    visit("vehicleLength", x.length);
    visit("vehicleWidth", x.width);
    visit("vehicleHeight", x.height);
    visit("trailerDataContainer", x.trailers);
  }
};

/// A piece of a map as a MAPEM names it.
struct map_reference {
  std::optional<integer<0, 65535>> region;
  integer<0, 65535> id;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("region", x.region);
    visit("id", x.id);
  }
};
using originating_roadside_unit =
    extensible_choice<alternative<"intersectionReferenceId", map_reference>,
                      alternative<"roadSegmentReferenceId", map_reference>>;

// -- the message --------------------------------------------------------------

struct management {
  static constexpr auto may_grow = extensible;
  struct segment {
    integer<1, 127> total, number;

    static constexpr void fields(auto& x, auto&& visit) {
      visit("totalMsgSegments", x.total);
      visit("thisSegmentNum", x.number);
    }
  };
  etsi::station_type station_type;
  std::optional<management::segment> segment;
  reference_position position;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("stationType", x.station_type);
    visit("perceivedObjectContainerSegmentInfo", x.segment);
    visit("referencePosition", x.position);
  }
};

struct cpm {
  static constexpr std::uint8_t protocol_version = 1;
  static constexpr std::uint8_t message_id = 14;

  using station_data = extensible_choice<
      alternative<"originatingVehicleContainer", originating_vehicle>,
      alternative<"originatingRSUContainer", originating_roadside_unit>>;

  struct parameters {
    static constexpr auto may_grow = extensible;
    tr103562::management management;
    std::optional<cpm::station_data> station_data;
    std::optional<extensible_sequence_of<sensor_information, 1, 128>> sensors;
    std::optional<extensible_sequence_of<perceived_object, 1, 128>> objects;
    std::optional<extensible_sequence_of<free_space_addendum, 1, 128>>
        free_space;
    integer<0, 255> number_of_objects; ///< In all segments.

    static constexpr void fields(auto& x, auto&& visit) {
      visit("managementContainer", x.management);
      visit("stationDataContainer", x.station_data);
      visit("sensorInformationContainer", x.sensors);
      visit("perceivedObjectContainer", x.objects);
      visit("freeSpaceAddendumContainer", x.free_space);
      visit("numberOfPerceivedObjects", x.number_of_objects);
    }
  };

  struct perception {
    /// Of the time when the position held.
    generation_delta_time generation;
    cpm::parameters parameters;

    static constexpr void fields(auto& x, auto&& visit) {
      visit("generationDeltaTime", x.generation);
      visit("cpmParameters", x.parameters);
    }
  };

  pdu_header header{protocol_version, message_id, {}};
  perception body;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("header", x.header);
    visit("cpm", x.body);
  }
};

} // namespace sofof::messages::etsi::tr103562
