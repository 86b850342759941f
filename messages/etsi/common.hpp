// What messages have in common: the data dictionary of release 1.
// Source: ETSI TS 102 894-2 v1.3.1.
#pragma once

#include "messages/etsi/schema.hpp"

namespace sofof::messages::etsi {

// Values that stand for "not known" and "beyond what can be said".
inline constexpr std::int32_t latitude_unavailable = 900'000'001;
inline constexpr std::int32_t longitude_unavailable = 1'800'000'001;
inline constexpr std::int32_t altitude_unavailable = 800'001;
inline constexpr std::uint16_t heading_unavailable = 3601;
inline constexpr std::uint16_t speed_unavailable = 16383;
inline constexpr std::int16_t acceleration_unavailable = 161;
inline constexpr std::int16_t curvature_unavailable = 1023;
inline constexpr std::int16_t yaw_rate_unavailable = 32767;
inline constexpr std::uint16_t semi_axis_unavailable = 4095;
/// Of headings, speeds, angles and steering wheels.
inline constexpr std::uint8_t confidence_unavailable = 127;
/// Of accelerations, distances and object dimensions.
inline constexpr std::uint8_t wide_confidence_unavailable = 102;

// ItsPduHeader

using station_id = integer<0, 4'294'967'295>;

/// Of a CAM or a CPM of release 1.
struct pdu_header {
  integer<0, 255> protocol_version;
  integer<0, 255> message_id;
  station_id station;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("protocolVersion", x.protocol_version);
    visit("messageID", x.message_id);
    visit("stationID", x.station);
  }
};

/// The same with the names of release 2 (TS 102 894-2 v2.1.1).
struct pdu_header_2 : pdu_header {
  static constexpr void fields(auto& x, auto&& visit) {
    visit("protocolVersion", x.protocol_version);
    visit("messageId", x.message_id);
    visit("stationId", x.station);
  }
};

using generation_delta_time = integer<0, 65535>; ///< ms, modulo 65536

/// 0 unknown, 5 passenger car, 15 roadside unit; the rest: docs/v2x.md.
using station_type = integer<0, 255>;
inline constexpr std::uint8_t passenger_car = 5;
inline constexpr std::uint8_t roadside_unit = 15;

// ReferencePosition

using latitude = integer<-900'000'000, latitude_unavailable>;     ///< 1e-7 °
using longitude = integer<-1'800'000'000, longitude_unavailable>; ///< 1e-7 °
using semi_axis = integer<0, semi_axis_unavailable>;              ///< cm
using heading_value = integer<0, heading_unavailable>; ///< 0.1 °, from north
using altitude_value = integer<-100'000, altitude_unavailable>; ///< cm

enum class altitude_confidence : std::uint8_t {
  within_1_cm,
  within_2_cm,
  within_5_cm,
  within_10_cm,
  within_20_cm,
  within_50_cm,
  within_1_m,
  within_2_m,
  within_5_m,
  within_10_m,
  within_20_m,
  within_50_m,
  within_100_m,
  within_200_m,
  out_of_range,
  unavailable,
};
template <>
inline constexpr auto names_of<altitude_confidence> =
    enumerated("alt-000-01", "alt-000-02", "alt-000-05", "alt-000-10",
               "alt-000-20", "alt-000-50", "alt-001-00", "alt-002-00",
               "alt-005-00", "alt-010-00", "alt-020-00", "alt-050-00",
               "alt-100-00", "alt-200-00", "outOfRange", "unavailable");

struct confidence_ellipse {
  semi_axis semi_major{semi_axis_unavailable};
  semi_axis semi_minor{semi_axis_unavailable};
  heading_value orientation{heading_unavailable};

  static constexpr void fields(auto& x, auto&& visit) {
    visit("semiMajorConfidence", x.semi_major);
    visit("semiMinorConfidence", x.semi_minor);
    visit("semiMajorOrientation", x.orientation);
  }
};

struct altitude {
  altitude_value value{altitude_unavailable};
  altitude_confidence confidence = altitude_confidence::unavailable;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("altitudeValue", x.value);
    visit("altitudeConfidence", x.confidence);
  }
};

struct reference_position {
  etsi::latitude latitude{latitude_unavailable};
  etsi::longitude longitude{longitude_unavailable};
  confidence_ellipse confidence;
  etsi::altitude altitude;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("latitude", x.latitude);
    visit("longitude", x.longitude);
    visit("positionConfidenceEllipse", x.confidence);
    visit("altitude", x.altitude);
  }
};

// Motion

/// A value and how sure it is, as the dictionary pairs them throughout.
/// @tparam value_name, confidence_name  In ASN.1.
template <literal value_name, literal confidence_name, class Value,
          class Confidence, auto unknown, auto unsure>
struct measured {
  Value value{unknown};
  Confidence confidence{unsure};

  static constexpr void fields(auto& x, auto&& visit) {
    visit(value_name.view(), x.value);
    visit(confidence_name.view(), x.confidence);
  }
};

using narrow_confidence = integer<1, confidence_unavailable>;
using wide_confidence = integer<0, wide_confidence_unavailable>;
using speed_value = integer<0, speed_unavailable>; ///< cm/s
using acceleration_value =
    integer<-160, acceleration_unavailable>; ///< 0.1 m/s²

using heading =
    measured<"headingValue", "headingConfidence", heading_value,
             narrow_confidence, heading_unavailable, confidence_unavailable>;
using speed =
    measured<"speedValue", "speedConfidence", speed_value, narrow_confidence,
             speed_unavailable, confidence_unavailable>;
using longitudinal_acceleration =
    measured<"longitudinalAccelerationValue",
             "longitudinalAccelerationConfidence", acceleration_value,
             wide_confidence, acceleration_unavailable,
             wide_confidence_unavailable>;
using lateral_acceleration =
    measured<"lateralAccelerationValue", "lateralAccelerationConfidence",
             acceleration_value, wide_confidence, acceleration_unavailable,
             wide_confidence_unavailable>;
using vertical_acceleration =
    measured<"verticalAccelerationValue", "verticalAccelerationConfidence",
             acceleration_value, wide_confidence, acceleration_unavailable,
             wide_confidence_unavailable>;

enum class curvature_confidence : std::uint8_t {
  within_0_00002,
  within_0_0001,
  within_0_0005,
  within_0_002,
  within_0_01,
  within_0_1,
  out_of_range,
  unavailable,
};
template <>
inline constexpr auto names_of<curvature_confidence> =
    enumerated("onePerMeter-0-00002", "onePerMeter-0-0001",
               "onePerMeter-0-0005", "onePerMeter-0-002", "onePerMeter-0-01",
               "onePerMeter-0-1", "outOfRange", "unavailable");
/// 1e-4 1/m, left positive.
using curvature =
    measured<"curvatureValue", "curvatureConfidence", integer<-1023, 1023>,
             curvature_confidence, curvature_unavailable,
             curvature_confidence::unavailable>;

enum class curvature_calculation_mode : std::uint8_t {
  yaw_rate_used,
  yaw_rate_not_used,
  unavailable,
};
template <>
inline constexpr auto names_of<curvature_calculation_mode> =
    enumerated_extensible("yawRateUsed", "yawRateNotUsed", "unavailable");

enum class yaw_rate_confidence : std::uint8_t {
  within_0_01,
  within_0_05,
  within_0_1,
  within_1,
  within_5,
  within_10,
  within_100,
  out_of_range,
  unavailable,
};
template <>
inline constexpr auto names_of<yaw_rate_confidence> =
    enumerated("degSec-000-01", "degSec-000-05", "degSec-000-10",
               "degSec-001-00", "degSec-005-00", "degSec-010-00",
               "degSec-100-00", "outOfRange", "unavailable");
/// 0.01 °/s, left positive.
using yaw_rate =
    measured<"yawRateValue", "yawRateConfidence", integer<-32766, 32767>,
             yaw_rate_confidence, yaw_rate_unavailable,
             yaw_rate_confidence::unavailable>;

enum class drive_direction : std::uint8_t { forward, backward, unavailable };
template <>
inline constexpr auto names_of<drive_direction> = enumerated("forward",
                                                             "backward",
                                                             "unavailable");

// Size

inline constexpr std::uint16_t vehicle_length_unavailable = 1023;
inline constexpr std::uint8_t vehicle_width_unavailable = 62;

enum class trailer_indication : std::uint8_t {
  none,
  known_length,
  unknown_length,
  presence_unknown,
  unavailable,
};
template <>
inline constexpr auto names_of<trailer_indication> =
    enumerated("noTrailerPresent", "trailerPresentWithKnownLength",
               "trailerPresentWithUnknownLength", "trailerPresenceIsUnknown",
               "unavailable");
/// 0.1 m.
using vehicle_length =
    measured<"vehicleLengthValue", "vehicleLengthConfidenceIndication",
             integer<1, vehicle_length_unavailable>, trailer_indication,
             vehicle_length_unavailable, trailer_indication::unavailable>;
using vehicle_width = integer<1, vehicle_width_unavailable>; ///< 0.1 m

} // namespace sofof::messages::etsi
