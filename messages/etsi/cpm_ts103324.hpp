// Collective Perception Message of release 2.
// Source: ETSI TS 103 324 v2.1.1.
#pragma once

#include "messages/etsi/common_release2.hpp"

namespace sofof::messages::etsi::ts103324 {

// -- the sender ---------------------------------------------------------------

struct originating_vehicle {
  static constexpr auto may_grow = extensible;
  wgs84_angle orientation;
  std::optional<cartesian_angle> pitch, roll;
  std::optional<extensible_sequence_of<trailer_data, 1, 8>> trailers;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("orientationAngle", x.orientation);
    visit("pitchAngle", x.pitch);
    visit("rollAngle", x.roll);
    visit("trailerDataSet", x.trailers);
  }
};

struct originating_roadside_unit {
  static constexpr auto may_grow = extensible;
  std::optional<etsi::map_reference> map_reference;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("mapReference", x.map_reference);
  }
};

// -- sensors ------------------------------------------------------------------

struct sensor_information {
  static constexpr auto may_grow = extensible;
  identifier_1b id;
  sensor_type type;
  std::optional<etsi::shape> shape;
  std::optional<confidence_level> confidence;
  bool shadowing = false;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("sensorId", x.id);
    visit("sensorType", x.type);
    visit("perceptionRegionShape", x.shape);
    visit("perceptionRegionConfidence", x.confidence);
    visit("shadowingApplies", x.shadowing);
  }
};
using sensor_information_container =
    extensible_sequence_of<sensor_information, 1, 128>;

struct perception_region {
  static constexpr auto may_grow = extensible;
  delta_time measured_at; ///< From the reference time on.
  confidence_level confidence;
  etsi::shape shape;
  bool shadowing = false;
  std::optional<sequence_of_identifier_1b> sensors;
  std::optional<cardinal_number_1b> number_of_objects;
  std::optional<extensible_sequence_of<identifier_2b, 0, 255>> objects;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("measurementDeltaTime", x.measured_at);
    visit("perceptionRegionConfidence", x.confidence);
    visit("perceptionRegionShape", x.shape);
    visit("shadowingApplies", x.shadowing);
    visit("sensorIdList", x.sensors);
    visit("numberOfPerceivedObjects", x.number_of_objects);
    visit("perceivedObjectIds", x.objects);
  }
};
using perception_region_container =
    extensible_sequence_of<perception_region, 1, 256>;

// -- perceived objects --------------------------------------------------------

inline constexpr std::uint16_t dimension_unavailable = 256;
inline constexpr std::uint8_t dimension_confidence_unavailable = 32;
/// 0.1 m, both.
using dimension =
    measured<"value", "confidence", integer<1, dimension_unavailable>,
             integer<1, dimension_confidence_unavailable>,
             dimension_unavailable, dimension_confidence_unavailable>;

struct object_class {
  /// Vehicle: station types. Other: 1 one object, 2 several, 3 bulk material.
  extensible_choice<alternative<"vehicleSubClass", integer<0, 14>>,
                    alternative<"vruSubClass", vru_profile>,
                    alternative<"groupSubClass", vru_cluster>,
                    alternative<"otherSubClass", integer<0, 255>>>
      what;
  confidence_level confidence;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("objectClass", x.what);
    visit("confidence", x.confidence);
  }
};

/// How the errors of an object's figures go together: a matrix below its
/// diagonal, in %, column by column.
struct correlation_matrix {
  using column = extensible_sequence_of<integer<-100, 101>, 1, 13>;
  /// Bits: x, y, z; velocity x, y, z; acceleration x, y, z; angle z, y, x;
  /// angular velocity.
  bit_string<13, extensible> components;
  extensible_sequence_of<column, 1, 13> columns;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("componentsIncludedIntheMatrix", x.components);
    visit("matrix", x.columns);
  }
};

/// Something that is perceived. x points east of the reference position, y
/// north, z up.
struct perceived_object {
  static constexpr auto may_grow = extensible;
  std::optional<identifier_2b> id; ///< In a CPM it is there.
  delta_time measured_at;          ///< From the reference time on.
  measured_position position;      ///< Of the middle of its bounding box.
  std::optional<etsi::velocity> velocity;
  std::optional<etsi::acceleration> acceleration;
  std::optional<euler_angles> angles;
  std::optional<angular_velocity> z_angular_velocity;
  std::optional<sequence_of<correlation_matrix, 1, 4>> correlations;
  std::optional<dimension> z_dimension, y_dimension, x_dimension;
  std::optional<integer<0, 2047>> age; ///< ms
  std::optional<integer<0, 15>> quality;
  std::optional<sequence_of_identifier_1b> sensors;
  std::optional<sequence_of<object_class, 1, 8>> classification;
  std::optional<etsi::map_position> map_position;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("objectId", x.id);
    visit("measurementDeltaTime", x.measured_at);
    visit("position", x.position);
    visit("velocity", x.velocity);
    visit("acceleration", x.acceleration);
    visit("angles", x.angles);
    visit("zAngularVelocity", x.z_angular_velocity);
    visit("lowerTriangularCorrelationMatrices", x.correlations);
    visit("objectDimensionZ", x.z_dimension);
    visit("objectDimensionY", x.y_dimension);
    visit("objectDimensionX", x.x_dimension);
    visit("objectAge", x.age);
    visit("objectPerceptionQuality", x.quality);
    visit("sensorIdList", x.sensors);
    visit("classification", x.classification);
    visit("mapPosition", x.map_position);
  }
};

struct perceived_object_container {
  static constexpr auto may_grow = extensible;
  cardinal_number_1b number_of_objects; ///< In all segments.
  extensible_sequence_of<perceived_object, 0, 255> objects;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("numberOfPerceivedObjects", x.number_of_objects);
    visit("perceivedObjects", x.objects);
  }
};

// -- the message --------------------------------------------------------------

struct management {
  static constexpr auto may_grow = extensible;
  struct segment {
    integer<1, 8> total, number;

    static constexpr void fields(auto& x, auto&& visit) {
      visit("totalMsgNo", x.total);
      visit("thisMsgNo", x.number);
    }
  };
  struct rate {
    integer<1, 100> mantissa;
    integer<-5, 2> exponent; ///< Of 10; Hz.

    static constexpr void fields(auto& x, auto&& visit) {
      visit("mantissa", x.mantissa);
      visit("exponent", x.exponent);
    }
  };
  struct rate_range {
    rate least, most;

    static constexpr void fields(auto& x, auto&& visit) {
      visit("messageRateMin", x.least);
      visit("messageRateMax", x.most);
    }
  };
  timestamp_its reference_time; ///< When the position held.
  reference_position position;
  std::optional<management::segment> segment;
  std::optional<management::rate_range> rate_range;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("referenceTime", x.reference_time);
    visit("referencePosition", x.position);
    visit("segmentationInfo", x.segment);
    visit("messageRateRange", x.rate_range);
  }
};

struct cpm {
  static constexpr std::uint8_t protocol_version = 2;
  static constexpr std::uint8_t message_id = 14;

  using container = open_type<
      integer<1, 16>,
      registered<1, "OriginatingVehicleContainer", originating_vehicle>,
      registered<2, "OriginatingRsuContainer", originating_roadside_unit>,
      registered<3, "SensorInformationContainer", sensor_information_container>,
      registered<4, "PerceptionRegionContainer", perception_region_container>,
      registered<5, "PerceivedObjectContainer", perceived_object_container>>;

  struct payload {
    static constexpr auto may_grow = extensible;
    ts103324::management management;
    /// It may not grow: a further constraint takes that away (X.680).
    sequence_of<container, 1, 8> containers;

    static constexpr void fields(auto& x, auto&& visit) {
      visit("managementContainer", x.management);
      visit("cpmContainers", x.containers);
    }
  };

  pdu_header_2 header{{protocol_version, message_id, {}}};
  payload body;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("header", x.header);
    visit("payload", x.body);
  }
};

} // namespace sofof::messages::etsi::ts103324
