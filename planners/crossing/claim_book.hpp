// What a vehicle claims of a crossing, what the others claim, and when it may
// rely on its own.
#pragma once

#include "planners/crossing/area_window.hpp"

#include <span>
#include <vector>

namespace sofof::planners {

/// The windows of one vehicle. A window is asked for, then it binds, and it
/// stays the vehicle's until it has left the area or gives it up.
///
/// A window binds once a message of each vehicle that matters is there which
/// was generated after it was asked for (by more than clocks may differ), and
/// none of them claims what overlaps. All messages of a vehicle tell all that
/// it claims. So of two overlapping windows at most one binds, whatever is
/// lost, late or out of order, and whoever proposed them: be the one asked for
/// at a, the other at b >= a. For the latter to bind, a message of the first
/// vehicle generated after b is needed, and that one tells of the window asked
/// for at a, or it is given up. (Two flags, as Dekker's; in Raynal, Concurrent
/// Programming, 2013, section 2.1.2.)
class claim_book {
public:
  struct rules {
    duration clock_error = std::chrono::milliseconds{5}; ///< Of any clock.
    /// Whoever was heard within this time matters.
    duration memory = std::chrono::seconds{2};
    /// What does not bind for so long is given up.
    duration patience = std::chrono::seconds{1};
  };

  explicit claim_book(station_id me) : claim_book(me, rules{}) {}
  claim_book(station_id me, rules r) : me_{me}, rules_{r} {}

  /// Asks for windows in place of what was asked for, or binds, before; that
  /// binds until these do. The same ones again change nothing.
  /// @param windows  None overlaps another one; not empty.
  /// @param needed   Whose consent is needed, besides that of everybody who
  ///                 was heard and whose way meets the own one.
  /// @returns false, and changes nothing, where they overlap what others claim.
  bool ask(time_point now, std::span<const area_window> windows,
           std::span<const station_id> needed);

  /// Takes what another vehicle tells, in any order.
  /// @param meets  Its way meets the own one.
  void hear(time_point now, const area_claims& told, bool meets);

  /// Gives up what has been asked for in vain, and forgets others.
  void pass_time(time_point now);

  /// The vehicle has left an area.
  void leave(std::uint32_t area);

  /// Gives up everything, while the vehicle can stop before all areas.
  void give_up();

  /// @returns what to tell now.
  area_claims tell(time_point now) const;

  std::span<const area_window> binding() const { return binding_; }
  std::span<const area_window> asked() const { return asked_; }

  /// @returns whether somebody else claims what overlaps.
  bool is_closed(const area_window& window) const;

private:
  struct other {
    station_id who = 0;
    time_point generated; // the newest message
    bool meets = false;
    std::vector<area_window> windows;
  };
  other* find(station_id who);
  bool is_closed(std::span<const area_window> windows) const;
  bool has_consented(station_id who) const;
  void bind_if_all_consent(time_point now);

  station_id me_;
  rules rules_;
  std::vector<area_window> binding_, asked_;
  time_point asked_at_;
  std::vector<station_id> needed_;
  std::vector<other> others_;
};

} // namespace sofof::planners
