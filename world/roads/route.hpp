// A way through the streets: lanes one after the other.
#pragma once

#include "base/geometry.hpp"
#include "world/roads/lane.hpp"
#include "world/roads/path.hpp"

#include <cassert>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace sofof::world {

/// A way through the map: lanes one after the other, and one smooth path
/// through all of them. Arc length `s_m` counts from the first lane's start;
/// on a closed route it may grow past the length, lap after lap.
class route {
public:
  /// Where a route is, in terms of lanes.
  struct place {
    std::size_t lane = 0; ///< Index into the map's lanes.
    double s_m = 0;       ///< Arc length on that lane.
  };

  /// @param lanes     All lanes of the map.
  /// @param sequence  Indices into `lanes`, at least one, each lane beginning
  ///                  where the one before ends (`road_map::make_route` sees
  ///                  to that); likewise the first after the last if closed.
  /// @param index     Of all lanes.
  route(std::string name, std::span<const lane> lanes,
        std::vector<std::size_t> sequence, bool closed,
        const lane_index& index);

  const std::string& name() const { return name_; }
  const world::path& path() const { return path_; }
  bool closed() const { return path_.closed(); }
  double length_m() const { return path_.length_m(); }

  /// Lanes in driving order, as indices into the map's lanes.
  std::span<const std::size_t> sequence() const { return sequence_; }

  /// Arc length where the i-th lane of the sequence begins, m; i may equal
  /// the number of lanes (then the length).
  double start_of_m(std::size_t i) const {
    assert(i <= sequence_.size());
    return starts_m_[i];
  }

  place at_lane(double s_m) const;
  double limit_mps(double s_m) const;
  double half_width_m(double s_m) const;

  /// How far it may be driven to the left of the centre line: as far as to the
  /// right, or to the far side of the lane's opposite.
  double left_m(double s_m) const;

  /// All at once, for who asks often, and the stretch on which they stay.
  struct bounds {
    double half_width_m, limit_mps, left_m;
    double from_m, to_m; ///< Within the lap that was asked for.

    bool apply_at(double s_m) const { return from_m <= s_m && s_m < to_m; }

    /// @returns whether what reaches from `low_m` to `high_m` across, left
    /// positive, is on the road.
    bool hold(double low_m, double high_m) const {
      return -low_m <= half_width_m && high_m <= left_m;
    }
  };
  bounds bounds_at(double s_m) const;

  /// Waypoints ahead: from `s_m` on, `spacing_m` apart, and last the point
  /// `ahead_m` away or an open route's end, whichever comes first.
  std::vector<point> waypoints(double s_m, double ahead_m,
                               double spacing_m) const;

private:
  struct leg {
    std::size_t index; // in the sequence
    double s_m;        // on that lane
  };
  leg find_leg(double s_m) const;

  std::string name_;
  world::path path_;
  std::vector<std::size_t> sequence_;
  std::vector<double> starts_m_;
  std::vector<std::vector<speed_zone>> limits_; // per lane of the sequence
  std::vector<double> half_widths_m_, left_m_;
};

using route_ptr = std::shared_ptr<const route>;

} // namespace sofof::world
