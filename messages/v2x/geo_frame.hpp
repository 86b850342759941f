// Where the map is on Earth, and which way its north points.
#pragma once

#include "base/geometry.hpp"
#include "world/roads/road_map.hpp"

#include <GeographicLib/LocalCartesian.hpp>
#include <cstdint>
#include <optional>

namespace sofof::messages {

/// A place on the WGS84 ellipsoid in ETSI's units, 1e-7 degrees: 1.1 cm of
/// latitude.
struct geo_position {
  static constexpr std::int32_t unavailable_latitude = 900'000'001;
  static constexpr std::int32_t unavailable_longitude = 1'800'000'001;

  std::int32_t latitude = unavailable_latitude;   ///< North positive.
  std::int32_t longitude = unavailable_longitude; ///< East positive.

  /// @returns whether it is a place at all.
  bool is_available() const;

  friend bool operator==(const geo_position&, const geo_position&) = default;
};

/// The map's frame on Earth: a plane that touches the ellipsoid in the map's
/// origin. Its axes are those of the UTM grid there, so that it is turned
/// against geographic east and north by the meridian convergence (by 0.7° in
/// Ulm, and by 0.02° more a kilometre farther east). A metre of the map is a
/// metre on Earth; the grid's own scale (0.03 % in Ulm, 0.3 m in a kilometre)
/// is left out, so that lengths and speeds need no conversion.
/// Good for maps of some kilometres.
class geo_frame {
public:
  /// @param origin  UTM, north of the equator. One without a zone or easting
  ///                (made-up maps) lies in Ulm-Lehr.
  /// @throws std::invalid_argument when there is no such place.
  explicit geo_frame(const world::geo_origin& origin = {});

  /// @param at  m, less than 100 km from the origin.
  geo_position to_wgs84(point at) const;

  /// @returns nothing for what is unavailable or farther than 100 km from
  /// the origin.
  std::optional<point> to_map(geo_position position) const;

  /// A vector given to geographic east (x) and north (y) at the place `at`, in
  /// the map's axes; and back.
  point to_map_axes(point east_north, point at) const;
  point to_east_north(point map_axes, point at) const;

  /// Between the map's heading (counter-clockwise from its x axis) and ETSI's
  /// (0.1° clockwise from geographic north, 0..3599; 3601 is unavailable).
  int to_etsi_heading(double heading_rad, point at) const;
  std::optional<double> to_map_heading(int etsi_heading, point at) const;

private:
  double east_rad(point at) const;

  GeographicLib::LocalCartesian plane_;
  double east_rad_ = 0;   // geographic east in the map, at the origin, ...
  double turn_radpm_ = 0; // ... and how it turns towards map east
  point axis_{1, 0};      // of geographic east in the map, at the origin
};

} // namespace sofof::messages
