// The streets: lanes, how they follow and cross each other, named routes.
#pragma once

#include "base/cell_grid.hpp"
#include "base/geometry.hpp"
#include "world/roads/conflict.hpp"
#include "world/roads/lane.hpp"
#include "world/roads/route.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace sofof::world {

/// A house, for occlusion: a rectangle, marked invented where it is.
struct building {
  std::vector<point> corners;
};

/// The geographic anchor of the east-north frame.
struct geo_origin {
  double utm_e_m = 0, utm_n_m = 0; ///< UTM of the frame's (0, 0).
  int utm_zone = 32;
  double lat_deg = 0, lon_deg = 0; ///< WGS84 of the same point.

  friend bool operator==(const geo_origin&, const geo_origin&) = default;
};

/// All streets of a scenario; immutable once built.
class road_map {
public:
  road_map() = default;

  /// Resolves names, finds conflicts.
  /// @throws std::invalid_argument with a sentence for a lane without points,
  ///         an unknown successor, a successor that begins elsewhere, a
  ///         doubled name, a speed limit or width that is missing or not
  ///         positive.
  road_map(std::string name, geo_origin origin, std::vector<lane> lanes,
           std::vector<building> buildings = {});

  const std::string& name() const { return name_; }
  const geo_origin& origin() const { return origin_; }
  std::span<const lane> lanes() const { return lanes_; }
  std::span<const building> buildings() const { return buildings_; }
  std::span<const conflict> conflicts() const { return conflicts_; }

  /// @throws std::invalid_argument naming the lane that is not on the map, or
  ///         the two that do not follow each other.
  route_ptr make_route(std::string name, std::span<const std::string> lanes,
                       bool closed) const;

  /// @returns whether some lane's centre line passes within `tolerance_m` of
  /// each of these points, to within 5 cm. O(1) for each; soonest done where
  /// they follow each other along a lane.
  bool near_lanes(std::span<const point> points, double tolerance_m) const;

private:
  /// A straight one of a centre line; the next one of the lane lies behind it
  /// in memory.
  struct piece {
    point from, along; // a unit vector
    double length_m;
    std::uint32_t followers; // in `followers_`, of a lane's last piece; else 0
  };

  void cut(const path& line);
  void resolve(const lane& l);
  void check_opposite(const lane& l, std::span<const path> paths) const;
  void join(std::span<const std::size_t> first_pieces);
  template <class Predicate>
  const piece* find_ahead(const piece* x, Predicate is_near) const;

  std::string name_;
  geo_origin origin_;
  std::vector<lane> lanes_;
  std::vector<building> buildings_;
  std::vector<conflict> conflicts_;
  std::vector<std::vector<std::size_t>> next_; // of each lane
  lane_index index_;
  std::vector<piece> pieces_;            // of one lane after the other
  std::vector<std::uint32_t> followers_; // first pieces; each list ends by none
  cell_grid cells_;                      // of the pieces
};

} // namespace sofof::world
