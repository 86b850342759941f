// Scene message: what the others mean on the way of one vehicle, told by who
// has made it out for that vehicle. Our own, in the manner of ETSI's messages,
// none of which says this: docs/v2x.md has it as a table.
#pragma once

#include "messages/etsi/common_release2.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace sofof::messages::scene {

// Longer lists are not told: what is left out could be what matters.
inline constexpr std::size_t most_crossings = 63;
inline constexpr std::size_t most_bodies = 31;
inline constexpr std::size_t most_yields = 31;
inline constexpr std::size_t most_kept_free = 31;
inline constexpr std::size_t most_moments = 256;

/// cm along the vehicle's way, from the reference position on: -163.84 m to
/// 491.51 m.
using arc_length = etsi::integer<-16'384, 49'151>;

/// A part of the way.
struct stretch {
  arc_length from;
  etsi::integer<0, 65'535> length; ///< cm

  static constexpr void fields(auto& x, auto&& visit) {
    visit("from", x.from);
    visit("length", x.length);
  }
};

/// When the rear of the lead will be where.
struct lead_moment {
  /// cm from the moment before; of the first, from the rear now.
  etsi::integer<0, 4095> way;
  /// 10 ms after the moment before; of the first, after the reference time.
  etsi::defaulted<etsi::integer<0, 16'383>, 20> time;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("way", x.way);
    visit("time", x.time);
  }
};

struct lead {
  std::optional<etsi::station_id> station;
  arc_length rear;
  etsi::integer<0, 16'383> speed;   ///< cm/s
  etsi::integer<-2048, 2047> accel; ///< cm/s²
  std::optional<etsi::sequence_of<lead_moment, 1, most_moments>> told;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("stationId", x.station);
    visit("rear", x.rear);
    visit("speed", x.speed);
    visit("acceleration", x.accel);
    visit("told", x.told);
  }
};

inline constexpr std::uint16_t stays_for_ever = 16'383;
inline constexpr std::uint8_t brakes_beyond = 63;

/// Somebody who crosses a part of the way.
struct crossing {
  stretch on;
  /// 10 ms after the reference time; the highest: then or later.
  etsi::integer<-8192, 8191> enter;
  etsi::integer<0, stays_for_ever> stay; ///< 10 ms, from `enter` on.
  bool goes_first = true;
  /// 0.1 m/s²: by so much it would have to brake to stay off; the highest: by
  /// more, or it cannot.
  etsi::integer<0, brakes_beyond> brakes{brakes_beyond};
  /// One number for all that one road user crosses, the same in later messages.
  etsi::integer<1, 4'294'967'295> body;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("on", x.on);
    visit("enter", x.enter);
    visit("stay", x.stay);
    visit("goesFirst", x.goes_first);
    visit("brakes", x.brakes);
    visit("body", x.body);
  }
};

using lateral_offset = etsi::integer<-32'768, 32'767>; ///< mm, left positive

/// Somebody who reaches into the lane and leaves room beside.
struct body_beside {
  stretch along;
  lateral_offset low, high;
  etsi::defaulted<etsi::integer<-131'072, 131'071>, 0> speed; ///< mm/s
  etsi::defaulted<etsi::integer<0, 2047>, 0> lacks;           ///< mm
  etsi::defaulted<etsi::integer<0, 16'383>, 0> left;          ///< mm

  static constexpr void fields(auto& x, auto&& visit) {
    visit("along", x.along);
    visit("low", x.low);
    visit("high", x.high);
    visit("speed", x.speed);
    visit("lacks", x.lacks);
    visit("left", x.left);
  }
};

/// Of the vehicle's rear axle.
struct reference_point {
  etsi::latitude latitude{etsi::latitude_unavailable};
  etsi::longitude longitude{etsi::longitude_unavailable};

  static constexpr void fields(auto& x, auto&& visit) {
    visit("latitude", x.latitude);
    visit("longitude", x.longitude);
  }
};

struct content {
  etsi::generation_delta_time generation; ///< Reference time of all others.
  /// ms: so old was the oldest look that this was made of.
  etsi::integer<0, 8191> age;
  reference_point reference;
  bool is_impatient = false;
  std::optional<scene::lead> lead;
  etsi::sequence_of<crossing, 0, most_crossings> crossings; ///< By `from`.
  etsi::sequence_of<body_beside, 0, most_bodies> beside;    ///< By `from`.
  etsi::sequence_of<arc_length, 0, most_yields> yields;     ///< Rising.
  etsi::sequence_of<stretch, 0, most_kept_free> keep_free;  ///< By `from`.

  static constexpr void fields(auto& x, auto&& visit) {
    visit("generationDeltaTime", x.generation);
    visit("age", x.age);
    visit("referencePosition", x.reference);
    visit("isImpatient", x.is_impatient);
    visit("lead", x.lead);
    visit("crossings", x.crossings);
    visit("beside", x.beside);
    visit("yields", x.yields);
    visit("keepFree", x.keep_free);
  }
};

} // namespace sofof::messages::scene

namespace sofof::messages {

struct scene_message {
  static constexpr std::uint8_t protocol_version = 1; ///< Of ours.
  /// ETSI counts up from 1 (TS 102 894-2); this is the last one there is.
  static constexpr std::uint8_t message_id = 255;

  etsi::pdu_header_2 header{{protocol_version, message_id, {}}};
  scene::content body;

  static constexpr void fields(auto& x, auto&& visit) {
    visit("header", x.header);
    visit("scene", x.body);
  }
};

} // namespace sofof::messages
