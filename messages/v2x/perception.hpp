// What a CPM says of the bodies that a vehicle perceives.
#pragma once

#include "messages/etsi/cpm_tr103562.hpp"
#include "messages/etsi/cpm_ts103324.hpp"
#include "messages/protocol/service.hpp"
#include "messages/v2x/cpm_rules.hpp"
#include "messages/v2x/georeference.hpp"
#include "messages/v2x/object_list.hpp"
#include "world/sensing/perception.hpp"
#include "world/sensing/sensors.hpp"
#include "world/vehicle/vehicle.hpp"

#include <optional>
#include <span>
#include <vector>

namespace sofof::messages {

/// What a vehicle has to tell.
struct perceived_scene {
  cam own;         ///< Its own motion, when it tells.
  time_point seen; ///< When it saw the objects.
  std::span<const known_object> objects;
  std::size_t perceived = 0; ///< All objects, those that it does not tell too.
  /// Its sensor, in the middle of its body, if it is to be told of.
  const world::sensor_params* sensor = nullptr;
  /// The sender is a roadside unit, at `own.position`; it heads nowhere. Only
  /// in release 2.
  bool at_roadside = false;
};

/// In the sender's frame: from the middle of its front, x where it is heading,
/// y to its left; both as the message gives them, so that rounding them moves
/// no object. Speeds and accelerations are over ground, along these axes.
/// Objects are where they were when they were seen.
etsi::tr103562::cpm make_cpm_tr103562(const perceived_scene& scene,
                                      const world::vehicle_params& car,
                                      const georeference& where);

/// @param now  The message tells its time modulo 65.536 s: the nearest to now
///             is meant.
/// @returns all objects of known size, moved on at constant speed to the time
/// at which the last of them was seen, and how the sender's sensor looks, if it
/// tells of one; nullopt if the sender does not say where it is or which way it
/// is heading.
std::optional<object_list> read_cpm(const etsi::tr103562::cpm& message,
                                    const georeference& where, time_point now);

/// The same in release 2: from the middle of the sender's front, x geographic
/// east, y north; objects 2 s old at most.
etsi::ts103324::cpm make_cpm_ts103324(const perceived_scene& scene,
                                      const world::vehicle_params& car,
                                      const georeference& where);

/// @returns as `read_cpm` of TR 103 562; what is told relative to lanes of a
/// map is left out.
std::optional<object_list> read_cpm(const etsi::ts103324::cpm& message,
                                    const georeference& where);

} // namespace sofof::messages
