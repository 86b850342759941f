// What one service says to the next of a vehicle's scene: a scene message.
#pragma once

#include "base/geometry.hpp"
#include "base/ids.hpp"
#include "base/time.hpp"
#include "messages/protocol/its_pdu.hpp"
#include "messages/v2x/georeference.hpp"
#include "planners/scene/driving_scene.hpp"

#include <optional>

namespace sofof::actors {

/// Where and when a scene was made out, and by whom.
struct scene_place {
  station_id station = 0; ///< Whose message it is.
  double s_m = 0;         ///< Of the own rear axle, as the scene's arc lengths.
  point position;         ///< Of the own rear axle, m, east-north.
  time_point at;          ///< That of the scene.
  time_point seen;        ///< The oldest look that it was made of.
};

/// Rounds to the cautious side, by less than a unit of the message: stretches
/// that others cross, or that stay free, get wider, are entered earlier and
/// left later; where crossings begin, and the lead, are nearer; the lead is
/// slower, and comes later than it tells; who has to brake has to brake harder;
/// bodies beside are larger. Those that move get longer by another half unit,
/// so that they cover for 10 s what they did before their speed was rounded.
/// Where room is lacking beside a body that is passed all the same, so much
/// more is lacking as the body is larger.
/// @returns a scene message of all but `stop_at_m` and `agreed`, which stay in
/// the vehicle. Nothing if not all can be told, so that what is told is never
/// too little: a list is longer than the message allows, or out of order; a
/// number is none, or beyond its range (but for late times, hard braking and
/// much room, of which less is told); the lead drives backwards as it tells, or
/// it tells and is not there; the look is of a time to come; `own.at` is not
/// `scene.at`.
messages::its_pdu make_scene_words(const planners::driving_scene& scene,
                                   const scene_place& own,
                                   const messages::georeference& where);

/// What is understood of a scene message.
struct decoded_scene {
  station_id from = 0;
  time_point at;   ///< The scene's, a whole millisecond of the time of day.
  time_point seen; ///< The oldest look that it was made of.
  point position;  ///< Of the rear axle that arc lengths are counted from, m,
                   ///< east-north, to a centimetre.
  planners::driving_scene scene; ///< Without `stop_at_m` and `agreed`.
};

/// @param where  As the reader has it; `message.ahead` is minded here.
/// @param now    The message tells its time modulo 65.536 s: the nearest to now
///               is meant.
/// @returns nullopt for what is no scene message, is farther than 100 km from
/// the map's origin, or has a list that is out of order. Of a scene lists are
/// in order and not longer than the message allows, no stretch ends before it
/// begins, no time of leaving is before that of entering, and all numbers are
/// finite but `leave_s` and `brakes_mps2`.
std::optional<decoded_scene>
read_scene_words(const messages::its_pdu& message,
                 const messages::georeference& where, time_point now);

/// @returns whether a scene that was told is neither of the future nor older
/// than any service may be late.
bool holds(const decoded_scene& scene, time_point now);

/// Moves a scene along the way.
/// @param by_m  Is added to all arc lengths.
void move(planners::driving_scene& scene, double by_m);

} // namespace sofof::actors
