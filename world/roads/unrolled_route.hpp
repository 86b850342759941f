// A route as the traffic sees it: its lanes and its crossings, lap after lap.
#pragma once

#include "world/roads/conflict_side.hpp"
#include "world/roads/route.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sofof::world {

/// A stretch of the own way that another lane crosses or joins: who is on one
/// side of a conflict excludes everybody on the other.
struct zone {
  double from_m = 0, to_m = 0; ///< Arc length on the route.
  std::uint32_t side = 0;      ///< As in `conflict_side`.
  int rank = 0;                ///< Of the own lane.
  double pace_mps = 0;         ///< At most what bends and limits allow there.

  std::uint32_t other_side() const { return side ^ 1U; }
};

/// The legs (lanes) and zones of a route, with the laps of a closed route
/// unrolled: both go on, and go back below zero, as arc length does.
class unrolled_route {
public:
  using leg = std::int64_t;

  unrolled_route(route_ptr on, const conflict_sides& all);

  const route_ptr& on() const { return on_; }

  /// @returns the leg at `s_m`; an open route's first or last beyond its ends.
  leg leg_at(double s_m) const;

  /// @returns whether there is such a leg: on closed routes, always.
  bool has(leg i) const { return on_->closed() || (i >= 0 && i < legs()); }

  /// @returns the index into the map's lanes.
  std::size_t lane(leg i) const { return on_->sequence()[index(i)]; }

  /// @returns the arc length where a leg begins, m. The one before ends there.
  double start_m(leg i) const {
    return static_cast<double>(lap(i)) * on_->length_m()
           + on_->start_of_m(index(i));
  }

  /// @returns how far one can go, m; infinity on closed routes.
  double end_m() const;

  /// Calls `visit(zone)` for every zone that begins in [from_m, to_m), in
  /// order, until it returns false; for none, where an end is no number.
  template <class Visitor>
  void for_zones(double from_m, double to_m, Visitor visit) const;

  double longest_zone_m() const { return longest_zone_m_; }

private:
  leg legs() const { return static_cast<leg>(on_->sequence().size()); }
  leg lap(leg i) const { return (i < 0 ? i - legs() + 1 : i) / legs(); }
  std::size_t index(leg i) const {
    return static_cast<std::size_t>(i - lap(i) * legs());
  }

  route_ptr on_;
  std::vector<zone> zones_; // of one lap, rising from_m
  double longest_zone_m_ = 0;
};

template <class Visitor>
void unrolled_route::for_zones(double from_m, double to_m,
                               Visitor visit) const {
  if (zones_.empty() || !std::isfinite(from_m) || !(from_m < to_m))
    return;
  // A zone must come out at the very same place whoever asks for it from
  // where: hence lap times length, and no trust in differences.
  constexpr auto rounding_m = 1e-3;
  const auto lap_m = on_->length_m();
  auto laps = on_->closed() ? std::floor(from_m / lap_m) : 0.0;
  auto next = std::ranges::lower_bound(
      zones_, from_m - laps * lap_m - rounding_m, {}, &zone::from_m);
  for (;; ++next) {
    if (next == zones_.end()) {
      if (!on_->closed())
        return;
      next = zones_.begin();
      ++laps;
    }
    auto z = *next;
    z.from_m += laps * lap_m;
    z.to_m += laps * lap_m;
    if (z.from_m >= to_m)
      return;
    if (z.from_m >= from_m && !visit(z))
      return;
  }
}

} // namespace sofof::world
