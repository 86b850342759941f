// A route as the planner samples it: bends, limits and width by arc length.
#pragma once

#include "world/roads/route.hpp"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace sofof::planners {

/// @returns the lower of the limits at the metres round a place; infinite
/// without any.
double seen_limit_mps(std::span<const double> most_mps, double s_m);

/// The centre line of a route, and its bounds, tabulated once. Arc lengths are
/// those of the route: closed routes wrap, open ones clamp.
class reference_line {
public:
  /// @param way       Kept.
  /// @param most_mps  No faster than this besides: at 0, 1, 2 … m, to the end;
  ///                  empty: no such limit.
  explicit reference_line(world::route_ptr way,
                          std::span<const double> most_mps = {});

  const world::route& way() const { return *way_; }

  /// 1/m; what is not finite has none (NaN).
  double curvature_1pm(double s_m) const;

  /// The lowest speed limit within a sample's step, m/s.
  double limit_mps(double s_m) const;

  /// Half of the lane, the narrowest within a sample's step, m.
  double half_width_m(double s_m) const;

  /// How far the line leaves its tangent at `s_m`, `ahead_m` further on
  /// (either sign), m, left positive.
  double bow_m(double s_m, double ahead_m) const;

private:
  struct section {
    double limit_mps = 0;
    double half_width_m = 0;

    bool operator==(const section&) const = default;
  };
  std::pair<const section&, const section&> around(double s_m) const;

  world::route_ptr way_;
  std::vector<section> sections_; // each unlike the one before
  // Of samples, equidistant, both ends included.
  std::vector<std::uint32_t> sections_at_;
  double steps_per_m_ = 0;
  double laps_per_m_ = 0;
};

} // namespace sofof::planners
