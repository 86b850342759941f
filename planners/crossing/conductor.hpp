// In which order vehicles go over a crossing, and how each of them drives.
#pragma once

#include "planners/crossing/approach.hpp"
#include "planners/crossing/crossing_spacing.hpp"
#include "planners/crossing/order_search.hpp"
#include "planners/crossing/window_drive.hpp"

#include <map>
#include <span>
#include <vector>

namespace sofof::planners {

/// What a conductor keeps to.
struct conducting {
  free_drive_limits alone;
  lag_margins margins;
  double looks_ahead_m = 150;
};

/// What a vehicle is told.
struct crossing_advice {
  station_id who = 0;
  /// From where it is to where its rear has left the crossing, standing still
  /// included; empty: there is none now.
  world::trajectory drive;
};

/// Plans all vehicles at a crossing together: a search for the order that
/// delays them least, then one drive after the other in this order, within what
/// those before it leave free. Where that is not possible for all, what was
/// told so far stays, and others come after that, as far as they can.
/// Deterministic.
class conductor {
public:
  conductor(crossing_ways ways, const conducting& how);
  conductor(const conductor&) = delete;
  conductor& operator=(const conductor&) = delete;
  ~conductor() = default;

  /// @param cars  In the order of their stations.
  /// @param out   One for each of them that is served, but for those that go
  ///              on as they were told.
  void plan(time_point now, std::span<const approaching_car> cars,
            std::vector<crossing_advice>& out);

private:
  void gather(time_point now, std::span<const approaching_car> all);
  approach make_approach(time_point now, const approaching_car& one,
                         const crossing_ways::place& at) const;
  void fix_leaders();
  bool arrange();
  order_problem pose();
  std::vector<order_problem::closure> closures(const approach& x);
  std::vector<std::size_t> likely_order(const order_problem& problem) const;
  bool drive_all(std::span<const std::size_t> order,
                 const std::vector<double>* at_s);
  bool drive(approach& x, std::span<const std::size_t> before,
             bool may_slip_in);
  bool goes_before(const approach& x, const approach& fixed);
  void list_windows(const approach& x, std::span<const std::size_t> others,
                    bool may_slip_in);
  bool is_kept(const approach& x) const;
  void tell(time_point now, std::vector<crossing_advice>& out);
  world::trajectory written(time_point now, const approach& x) const;

  crossing_ways ways_;
  conducting how_;
  crossing_spacing spacing_;
  order_search search_;
  window_drive drives_;
  std::map<station_id, time_point> wishes_; // to be at the line
  std::vector<station_id> last_order_, order_;
  std::vector<approach> cars_;
  std::vector<std::size_t> free_; // of them, as they come, lane by lane
  place_windows windows_;         // of a car
};

} // namespace sofof::planners
