// What is seen, and what is known of it, as CPMs.
#pragma once

#include "actors/services/planning/planning_world.hpp"
#include "messages/protocol/its_pdu.hpp"
#include "messages/protocol/service.hpp"
#include "messages/v2x/object_list.hpp"
#include "planners/scene/track.hpp"
#include "world/sensing/perception.hpp"

#include <optional>
#include <span>

namespace sofof::actors {

/// Who tells tracks.
struct track_teller {
  messages::cam own;        ///< Of a provider: its station and its place.
  bool at_roadside = false; ///< It is a provider.
};

/// @returns one CPM of all that the vehicle sees in one look. Its objects are
/// numbered within the look.
messages::its_pdu make_look_words(const messages::cam& own,
                                  const world::perception& seen,
                                  const planning_world& world);

/// @param near  The nearest to there are told, if there are more than a CPM
///              holds.
/// @returns one CPM of all tracks but those of `leaves_out`.
messages::its_pdu make_track_words(const track_teller& from, point near,
                                   std::span<const planners::track> tracks,
                                   station_id leaves_out,
                                   const planning_world& world);

/// @returns what a CPM tells; nullopt if it is none, or of a later time.
std::optional<messages::object_list>
read_objects(const messages::its_pdu& message, const planning_world& world,
             time_point now);

} // namespace sofof::actors
