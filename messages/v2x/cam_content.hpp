// What a CAM says of a vehicle.
#pragma once

#include "messages/etsi/cam.hpp"
#include "messages/protocol/service.hpp"
#include "messages/v2x/georeference.hpp"
#include "messages/v2x/path_history.hpp"
#include "world/vehicle/vehicle.hpp"

#include <optional>

namespace sofof::messages {

/// @returns the middle of the front: a vehicle's reference position in ETSI's
/// messages. Source: EN 302 637-2 v1.4.1, annex B.
point front_of(const cam& own, const world::vehicle_params& car);

/// @param own  The rear axle's motion. The message tells the middle of the
///             front, and all quantities in ETSI's units.
/// @returns the CAM without its low-frequency container.
etsi::cam make_cam(const cam& own, const world::vehicle_params& car,
                   const georeference& where);

/// Adds the low-frequency container: where the vehicle has been.
/// @param been  Of the middle of its front.
void add_path(etsi::cam& message, const cam& own, const path_history& been,
              const georeference& where);

/// @param now  The message tells its time modulo 65.536 s: the nearest to now
///             is meant.
/// @returns what a vehicle tells of its rear axle, which is where it would be
/// in a car of ours scaled to its length; what it does not know counts as
/// zero, the length as that of `car`. Nullopt for a roadside unit, for who
/// does not know where it is, which way it points, or how fast it is.
std::optional<cam> read_cam(const etsi::cam& message,
                            const world::vehicle_params& car,
                            const georeference& where, time_point now);

} // namespace sofof::messages
