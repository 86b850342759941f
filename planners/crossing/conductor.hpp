// In which order vehicles go over a crossing, and how each of them drives.
#pragma once

#include "planners/crossing/crossing_ways.hpp"
#include "planners/crossing/lag.hpp"
#include "planners/crossing/order_search.hpp"
#include "planners/crossing/window_drive.hpp"
#include "planners/scene/planning_input.hpp"
#include "planners/speed/speed_planner.hpp"

#include <map>
#include <optional>
#include <span>
#include <vector>

namespace sofof::planners {

/// What a conductor keeps to.
struct conducting {
  comfort_limits style;
  free_drive_limits alone;
  lag_margins margins;
  double looks_ahead_m = 150;
  duration fixed_for = std::chrono::seconds{4}; ///< Before it enters, a claim
                                                ///< is not changed any more.
  double sets_off_within_s = 5; ///< A car at rest is not told to later ones.
};

/// A vehicle on its way, as it is known at the crossing.
struct approaching_car {
  station_id who = 0;
  route_profile_ptr way; ///< Not null.
  double s_m = 0;        ///< Rear axle on its route, laps included.
  double speed_mps = 0, accel_mps2 = 0;
  bool is_served = true; ///< It can be told how to drive.
  /// Of its own claim, from now on: this does not change if it begins soon.
  std::optional<world::trajectory> claimed;
  bool is_fixed = false; ///< It has claimed it.
};

/// What a vehicle is told.
struct crossing_advice {
  station_id who = 0;
  /// From where it is, or sets off, to where its rear has left the crossing;
  /// empty: it waits.
  world::trajectory drive;
  double line_m = 0;     ///< Rear axle, laps included: where it would wait.
  time_point not_before; ///< It will not be told to enter before that.
};

/// Plans all vehicles at a crossing together: a search for the order that
/// delays them least, then one velocity problem after the other in this order,
/// each with what those before it leave free. Deterministic.
class conductor {
public:
  int kept = 0, failed = 0;
  conductor(crossing_ways ways, const conducting& how,
            const world::vehicle_params& car);

  /// @param cars  In order of their stations.
  /// @param out   One for each of them that is served and not told already.
  void plan(time_point now, std::span<const approaching_car> cars,
            std::vector<crossing_advice>& out);

private:
  struct car { // with what is computed of it
    const approaching_car* is;
    crossing_ways::place at;
    double line_m = 0;  // of its middle: the crossing begins,
    way_motion alone;          // from now on, if nobody else were there
    way_motion claimed;        // empty: nothing is
    bool is_committed = false; // to enter, whatever it claims
    bool is_fixed = false;
    double wish_s = 0; // at the line
    double line_s = 0; // as the search has it
    way_motion motion; // fixed or planned; empty: it waits
  };
  void gather(time_point now, std::span<const approaching_car> all);
  void fix_leaders();
  double left_m(const car& x) const;
  bool is_ahead(const car& a, const car& b) const;
  kept_apart gap(const car& first, const car& then) const;
  double lag_s(const car& first, const car& then);
  std::optional<order_problem::closure> closure(const car& fixed,
                                                const car& then);
  bool arrange();
  order_problem pose();
  std::vector<std::size_t> likely_order(const order_problem& problem) const;
  bool drive_all(std::span<const std::size_t> order,
                 const std::vector<double>* at_s);
  bool drive(car& x, std::span<const std::size_t> before, bool may_slip_in);
  bool is_kept(const car& x) const;
  bool goes_before(const car& x, const car& fixed);
  void list_windows(const car& x, std::span<const std::size_t> others,
                    bool may_slip_in);
  void tell(time_point now, std::vector<crossing_advice>& out);

  crossing_ways ways_;
  conducting how_;
  world::vehicle_params car_;
  order_search search_;
  window_drive drives_;
  std::map<station_id, time_point> wishes_; // to be at the line
  std::vector<station_id> last_order_, order_;
  std::vector<car> cars_;
  std::vector<std::size_t> free_; // of them, as they come, lane by lane
  std::vector<double> earliest_s_, latest_s_; // of a car, place by place
};

} // namespace sofof::planners
