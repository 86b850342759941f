// What a service at a provider may hear besides its inputs.
#pragma once

#include "messages/protocol/motion.hpp"
#include "messages/protocol/service.hpp"
#include "messages/v2x/mcm/mcm_content.hpp"
#include "messages/v2x/object_list.hpp"
#include "offloading/service.hpp"
#include "planners/plausibility/station_doubt.hpp"

#include <vector>

namespace sofof::actors {

/// Who is told of all that one provider hears and sees.
class broadcast_listener {
public:
  virtual ~broadcast_listener() = default;

  /// A CAM has come, from anybody near enough to be heard: in the area or not,
  /// perhaps with no service, perhaps overtaken by a later one on its way.
  virtual void on_cam(const messages::cam& c, sender_id from) = 0;

  /// A CPM has come, likewise.
  virtual void on_objects(const messages::object_list& told,
                          sender_id from) = 0;

  /// An MCM has come that a vehicle tells everybody, likewise.
  virtual void on_word(const messages::decoded_mcm&, sender_id) {}

  /// One of the provider's sensors at the roadside has looked at the road.
  virtual void on_detections(const messages::roadside_detections& view) = 0;

  /// @returns which stations have come to be doubted or believed again since
  /// the last call, the oldest first.
  virtual std::vector<planners::station_doubt> take_doubts() { return {}; }
};

/// A service that listens at its provider.
class listening_service : public offloading::provider_service {
public:
  /// @returns who is told; null: nobody. Asked once: it is the same one for as
  /// long as the service is there.
  virtual broadcast_listener* listener() = 0;
};

/// @returns who of a service is told; null for one that does not listen.
inline broadcast_listener* listener_of(offloading::provider_service& service) {
  auto* listens = dynamic_cast<listening_service*>(&service);
  return listens ? listens->listener() : nullptr;
}

} // namespace sofof::actors
