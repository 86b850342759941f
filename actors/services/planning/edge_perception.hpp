// What a provider knows of the road: all CAMs and CPMs, and what its own
// sensors see, put together.
#pragma once

#include "actors/offloading/broadcast_listener.hpp"
#include "actors/services/planning/known_others.hpp"
#include "messages/v2x/generation_rules.hpp"
#include "planners/plausibility/plausibility.hpp"
#include "planners/scene/object_tracker.hpp"
#include "planners/scene/told_drive.hpp"

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace sofof::actors {

/// @returns the body of a vehicle that has sent a CAM. Its rear axle is as far
/// forward in it as in a car of ours.
world::perceived_object body_of(const messages::cam& c);

/// What is told of later than now is not believed, nor are bodies that
/// `plausibility` doubts. What vehicles say of their drives is taken as it is:
/// it closes places, and moves nobody.
class edge_perception final : public broadcast_listener, public others_source {
public:
  /// @param houses  Of the map; they hide what is behind them.
  /// @param noise   Of those who tell what they see.
  /// @param where   The map is; null: what vehicles say of their drives is not
  ///                understood.
  explicit edge_perception(std::function<time_point()> clock,
                           std::span<const world::building> houses = {},
                           const planners::sighting_noise& noise = {},
                           messages::georeference_ptr where = nullptr);

  void on_cam(const messages::cam& c, sender_id from) override;
  void on_objects(const messages::object_list& told, sender_id from) override;
  void on_word(const messages::decoded_mcm& word, sender_id from) override;
  void on_detections(const messages::roadside_detections& view) override;
  std::vector<planners::station_doubt> take_doubts() override;

  /// @returns what a vehicle told of itself last, unless that is older than
  /// protocol::cam_timeout.
  std::optional<messages::cam> told_by(station_id who) const;

  /// @returns whether a vehicle has been heard for long enough, without a gap,
  ///          to know what is round it: bodies that stand are told of once a
  ///          second, and what nothing is known of yet has no sides to pass by.
  bool knows_surroundings_of(station_id who) const;

  void drives(std::vector<planners::told_drive>& out,
              station_id station) override;
  void tracks(std::vector<planners::track>& out, station_id station) override;

private:
  void forget_silent(time_point now);
  planners::road_look look_of(const messages::object_list& told) const;

  std::function<time_point()> clock_;
  mutable std::mutex mutex_;
  // Told by CAMs and CPMs, which come when there is news.
  planners::object_tracker model_;
  planners::plausibility doubts_;
  struct voice {
    messages::cam newest;
    time_point since; ///< It has been heard without a gap.
  };
  std::map<station_id, voice> told_; // by CAMs
  struct said {
    time_point at;
    planners::claimed_drive drive;
    bool is_claimed = false;
    point front;
  };
  std::map<station_id, said> said_; // of their drives, by MCMs
  messages::georeference_ptr where_;
  time_point tidied_;
};

} // namespace sofof::actors
