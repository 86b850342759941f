// Whose turn it is at the crossings.
//
// A zone is closed to everybody until granted. The grants keep two promises:
// 1. Whoever has a zone keeps it until its rear has left, and meanwhile
//    nobody on the conflict's other side gets it. So bodies never meet. Who
//    stands before it for long, as its way out is not free, gives it back.
// 2. Whoever gets a zone can leave it, and everything before the next stop
//    line, without any further grant: all zones that follow too closely to
//    stop in between are granted together, and behind the last one there is
//    room, even if nobody else is ever granted anything again. So every zone
//    comes free in the end, and waiting for one never goes in circles.
// 3. No roundabout is more than half full, so that somebody on it always finds
//    room to go on. One place is kept for who has asked for longest, for
//    more than 20 s, and finds its zones taken.
// What is left is waiting for room, which can go in circles (a block of
// streets, each full, each leading into the next). Who has waited for long
// therefore asks together with those that stand in its way: all of them go,
// or none. That fails only when two of them cross each other's way, which
// takes a town with more than six of ten places to stand taken.
#pragma once

#include "base/time.hpp"
#include "world/roads/roundabouts.hpp"
#include "world/traffic/lane_order.hpp"
#include "world/traffic/road_user_state.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace sofof::world {

/// Grants zones to drivers; remembers nothing that is not in `road_user_state`.
class right_of_way {
public:
  explicit right_of_way(const road_map& map)
      : roundabouts_{map}, users_(2 * map.conflicts().size()),
        on_roundabout_(roundabouts_.count()) {}

  /// Decides on every request anew. Who comes near a zone without the right
  /// to it asks. Order: lower rank, then who asked first, then lower station
  /// id; who has waited long comes before all ranks. A request is refused
  /// when there is no room behind the crossing, when somebody has a zone's
  /// other side, or when somebody with priority there would arrive before it
  /// is clear again, unless that one cannot go itself.
  /// @param drivers  In any fixed order; sorted into `order`.
  void decide(std::span<road_user_state> drivers, const lane_order& order,
              time_point now);

private:
  struct user {
    std::uint32_t who;
    zone on;
  };
  struct request { // to be granted together with others
    std::uint32_t who;
    std::size_t first_zone, end_zone; // in wanted_
    double clear_m;                   // end of the last zone
  };

  void enter(std::uint32_t who);
  void give_back(std::uint32_t who);
  void find_line(road_user_state& d) const;
  bool is_impatient(const road_user_state& d) const;
  bool goes_before(const road_user_state& a, int rank_a,
                   const road_user_state& b, int rank_b) const;
  road_user_state::answer ask(std::uint32_t who);
  void keep_a_place(std::uint32_t who);
  bool join(std::uint32_t who);
  std::size_t roundabout_between(const road_user_state& d, double from_m,
                                 double to_m) const;
  std::size_t roundabout_of(const road_user_state& d) const;
  bool may_be_let_on(const request& r) const;
  bool can_reach(std::uint32_t who, double front_m);
  bool finds_room(std::uint32_t who, double front_m);
  bool is_idle(std::uint32_t who) const;
  const request* find_request(std::uint32_t who) const;
  bool is_held(const request& r) const;
  bool excludes(const request& a, const request& b) const;
  bool gives_way(const request& r) const;
  std::span<const zone> zones(const request& r) const {
    return std::span{wanted_}.subspan(r.first_zone, r.end_zone - r.first_zone);
  }

  std::span<road_user_state> drivers_;
  const lane_order* order_ = nullptr;
  time_point now_;
  roundabouts roundabouts_;
  std::vector<std::vector<user>> users_;   // of each side, near or on it
  std::vector<std::size_t> on_roundabout_; // or let on to it
  std::vector<bool> kept_a_place_;         // on each, in this decision
  std::vector<std::uint32_t> asking_;
  std::vector<request> party_; // who asks together
  std::vector<zone> wanted_;   // all zones of the party
  int looks_ = 0;              // at road users, for one request
};

} // namespace sofof::world
