// What stations of other programs say on the air.
#pragma once

#include "messages/broadcast/decode_broadcast.hpp"
#include "messages/type_ids.hpp"

#include <caf/actor.hpp>
#include <caf/actor_system.hpp>

#include <functional>
#include <set>
#include <vector>

namespace sofof::actors {

/// Who hears it.
struct foreign_air_setup {
  std::vector<messages::provider_actor> providers; ///< However far away.
  messages::air_actor air; ///< Of vehicles; may be null.
  std::function<messages::broadcast(const messages::its_pdu&, time_point)>
      decode;
  std::set<station_id> own; ///< Whoever says to be one of these is not heard.
};

/// Stations that nobody has proved to be there: providers see them as bodies on
/// the road, all told by one sender, and serve none of them.
class foreign_air {
public:
  foreign_air(caf::actor_system& sys, foreign_air_setup setup);
  ~foreign_air();
  foreign_air(const foreign_air&) = delete;
  foreign_air& operator=(const foreign_air&) = delete;

  /// A message has come, from anybody; on any thread.
  void on_message(messages::its_pdu message) const;

private:
  caf::actor ear_;
};

} // namespace sofof::actors
