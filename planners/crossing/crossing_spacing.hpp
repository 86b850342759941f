// What vehicles at a crossing leave between them.
#pragma once

#include "planners/crossing/approach.hpp"
#include "planners/crossing/lag.hpp"
#include "planners/crossing/order_problem.hpp"

#include <optional>
#include <vector>

namespace sofof::planners {

/// When a vehicle may be where: at its present place, and each
/// `window_drive::step_m` from there on.
struct place_windows {
  std::vector<double> earliest_s, latest_s;
};

/// Compares vehicles on their ways, two by two.
class crossing_spacing {
public:
  /// @param ways  Outlive it.
  crossing_spacing(crossing_ways& ways, const lag_margins& margins)
      : ways_{ways}, margins_{margins} {}

  /// @returns way to where the lane ends on which it comes, m; negative beyond.
  double left_m(const approach& x) const;

  /// @returns whether `a` drives ahead of `b` on the lane on which both come.
  bool is_ahead(const approach& a, const approach& b) const;

  /// @returns how much later than the first one the other may be at its line,
  /// s; `order_problem::never_meet` if they do not meet.
  double lag_s(const approach& first, const approach& then);

  /// @returns when a vehicle may not be at its line because of one that is
  /// fixed; nullopt: it may whenever.
  std::optional<order_problem::closure> closure(const approach& fixed,
                                                const approach& then);

  /// Closes what another one takes, who goes first, to a vehicle.
  /// @param own   Both lists as long as needed.
  void go_after(const approach& first, const approach& x, place_windows& own);

  /// Has a vehicle clear what another one, who goes later, takes.
  void go_before(const approach& then, const approach& x, place_windows& own);

private:
  kept_apart gap(const approach& first, const approach& then) const;

  crossing_ways& ways_;
  lag_margins margins_;
};

} // namespace sofof::planners
