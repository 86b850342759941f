// What a vehicle tells everybody: its CAMs and CPMs.
#pragma once

#include "messages/protocol/its_pdu.hpp"
#include "messages/protocol/service.hpp"
#include "messages/v2x/cam_rules.hpp"
#include "messages/v2x/cpm_rules.hpp"
#include "messages/v2x/georeference.hpp"
#include "messages/v2x/path_history.hpp"
#include "messages/v2x/v2x_options.hpp"
#include "planners/scene/object_tracker.hpp"
#include "world/sensing/perception.hpp"
#include "world/sensing/sensors.hpp"
#include "world/vehicle/vehicle.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace sofof::actors {

/// Decides what is due and encodes it. Objects keep their names in CPMs as
/// long as an environment model of the vehicle's own recognises them; what is
/// told of them is what the model makes of all sightings.
class v2x_broadcast {
public:
  v2x_broadcast(const messages::v2x_options& options,
                const world::vehicle_params& car,
                const world::sensor_params& sensor,
                messages::georeference_ptr where);

  /// The vehicle is here now; every protocol::ego_period.
  /// @returns its CAM, if one is due.
  std::optional<messages::its_pdu> awareness(const messages::cam& own);

  /// @param own   The vehicle's motion now.
  /// @param seen  What it saw last.
  /// @returns its CPM, if one is due.
  std::optional<messages::its_pdu> perceived(const messages::cam& own,
                                             const world::perception& seen);

private:
  messages::v2x_options options_;
  world::vehicle_params car_;
  world::sensor_params sensor_;
  messages::georeference_ptr where_;
  messages::cam_trigger cam_due_;
  messages::path_history been_;
  /// What CPMs are made of.
  struct seen_bodies {
    messages::cpm_trigger due;
    planners::object_tracker model;
    std::vector<messages::known_object> known, told; // one after the other
  };
  std::unique_ptr<seen_bodies> seen_; // null where none are sent
};

} // namespace sofof::actors
