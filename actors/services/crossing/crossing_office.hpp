// What a provider knows of a crossing, and how it conducts it.
#pragma once

#include "actors/offloading/broadcast_listener.hpp"
#include "actors/services/crossing/crossing_options.hpp"

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <vector>

namespace sofof::actors {

/// Hears everybody, plans all together every half second, and tells each of
/// those that ask its part.
class crossing_office final : public broadcast_listener {
public:
  static constexpr duration period = std::chrono::milliseconds{500};

  crossing_office(crossing_world_ptr world, std::function<time_point()> clock);

  void on_cam(const messages::cam& c, sender_id from) override;
  void on_objects(const messages::object_list&, sender_id) override {}
  void on_detections(const messages::roadside_detections&) override {}
  void on_word(const messages::decoded_mcm& word, sender_id from) override;

  /// @returns how this vehicle is to drive, as of now; empty: nothing is known
  /// of it, or it comes to no crossing.
  world::trajectory advise(time_point now, station_id who);

  /// It does not ask any more.
  void leave(station_id who);

private:
  struct heard {
    messages::cam newest;
    std::optional<messages::decoded_mcm> word;
    planners::route_profile_ptr way;
    double s_m = 0;
  };
  void forget_silent(time_point now);
  void plan(time_point now);
  bool place(heard& x) const;
  world::trajectory plan_of(const heard& x) const;
  planners::route_profile_ptr profile(const world::route_ptr& way);

  crossing_world_ptr world_;
  std::function<time_point()> clock_;
  std::mutex mutex_;
  planners::conductor conductor_;
  std::map<station_id, heard> heard_;
  std::set<station_id> asks_;
  std::map<station_id, world::trajectory> advice_;
  std::map<const world::route*, planners::route_profile_ptr> profiles_;
  std::optional<time_point> planned_;
};

} // namespace sofof::actors
