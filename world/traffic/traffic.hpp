// Who is where on the road, who touches whom, and whose turn it is. This is
// the ground truth that sensors and traffic rules are derived from.
#pragma once

#include "base/ids.hpp"
#include "base/time.hpp"
#include "world/roads/road_body.hpp"
#include "world/roads/road_map.hpp"
#include "world/sensing/perception.hpp"

#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace sofof::world {

/// One road user, as the traffic sees it.
struct road_user {
  station_id station = 0;
  route_ptr on;   ///< Its route.
  double s_m = 0; ///< Rear axle on the route, laps included.
  double speed_mps = 0;
  double accel_mps2 = 0;
  double front_m = 4.0175; ///< Rear axle to front bumper.
  double rear_m = 1.0825;  ///< Rear axle to rear bumper.
  oriented_box body;       ///< Where it really is.
};

/// All road users. Neighbours are found along the lanes, bodies that touch by
/// a sweep, never by comparing all pairs. What comes out does not depend on
/// the order of the reports.
class traffic {
public:
  /// @param standing  Bodies that never move. They touch others, but the
  ///                  rules of the road do not know them. Their ids are no
  ///                  road user's.
  /// @param grants_crossings  Grants every crossing, and so keeps everybody
  ///                          apart. Else nobody is granted anything: drivers
  ///                          judge crossings by what they perceive and by
  ///                          the ranks of the lanes.
  explicit traffic(const road_map& map, std::vector<road_body> standing = {},
                   bool grants_crossings = true);
  traffic(traffic&&) noexcept;
  traffic& operator=(traffic&&) noexcept;
  ~traffic();

  /// Adds a road user, or replaces what is known of it. With another route it
  /// loses what was granted on the old one: change routes before crossings.
  void report(const road_user& user);

  void remove(station_id station);

  /// Replaces the bodies that move by themselves. They touch others, but the
  /// rules of the road do not know them. Their ids are no road user's.
  void place(std::vector<road_body> moving);

  /// Decides every crossing anew, if crossings are granted, and finds who
  /// touches whom.
  /// A crossing (zone of a `conflict`) is closed by default and granted in
  /// lane order, to those who find room behind it; who holds it keeps it until
  /// its rear has left. Right of way: lower rank first, then earlier arrival
  /// at the zone, then lower station id; a lower priority is granted only when
  /// it clears the zone before anybody of higher priority arrives, but who has
  /// waited for 20 s goes before all ranks. So nobody waits for ever. A grant
  /// is never revoked, so acting on an old perception is safe.
  void update(time_point now);

  /// @returns what `station` perceives, as of the last `update`; before its
  /// first one it must not move.
  /// @throws std::out_of_range when there is no such road user.
  perception perceive(station_id station) const;

  /// @returns all road users in the order of their stations, then what stands
  /// on the road, then what moves by itself, as of the last `update`; valid
  /// until the next one.
  std::span<const road_body> bodies() const;

  /// @returns all road users in the order of their stations, as of the last
  /// `update`; valid until the next one.
  std::span<const road_user> users() const;

  /// @returns the pairs of bodies that touch, lower id first, in rising order,
  /// as of the last `update`; not those of which neither is a road user.
  std::vector<std::pair<station_id, station_id>> collisions() const;

private:
  struct state;
  std::unique_ptr<state> state_;
};

} // namespace sofof::world
