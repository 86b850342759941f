// Tangential plane, turned by the meridian convergence.
#include "messages/v2x/geo_frame.hpp"

#include "messages/etsi/units.hpp"

#include <GeographicLib/UTMUPS.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace sofof::messages {
namespace {

constexpr world::geo_origin ulm_lehr{571656, 5364810, 32, 48.43236, 9.96873};
constexpr double per_degree = 1e7;
constexpr std::int32_t largest_latitude = 900'000'000;
constexpr std::int32_t largest_longitude = 1'800'000'000;
constexpr double largest_distance_m = 1e5;
constexpr double earth_radius_m = 6'378'137; // WGS84

std::int32_t to_integer(double degrees) {
  return static_cast<std::int32_t>(std::lround(degrees * per_degree));
}

/// `v` turned counter-clockwise by the angle of `by`.
point turned(point v, point by) {
  return {by.x_m * v.x_m - by.y_m * v.y_m, by.y_m * v.x_m + by.x_m * v.y_m};
}

point mirrored(point v) {
  return {v.x_m, -v.y_m};
}

point direction(double angle_rad) {
  return {std::cos(angle_rad), std::sin(angle_rad)};
}

/// How far the ellipsoid falls below its tangential plane.
double fall_m(point east_north) {
  return dot(east_north, east_north) / (2 * earth_radius_m);
}

} // namespace

bool geo_position::is_available() const {
  return std::abs(std::int64_t{latitude}) <= largest_latitude
         && std::abs(std::int64_t{longitude}) <= largest_longitude;
}

geo_frame::geo_frame(const world::geo_origin& origin) {
  const auto& at = origin.utm_e_m > 0 ? origin : ulm_lehr;
  double latitude = 0, longitude = 0, convergence = 0, scale = 0;
  try {
    GeographicLib::UTMUPS::Reverse(at.utm_zone, true, at.utm_e_m, at.utm_n_m,
                                   latitude, longitude, convergence, scale);
  } catch (const GeographicLib::GeographicErr& e) {
    throw std::invalid_argument{e.what()};
  }
  plane_.Reset(latitude, longitude);
  // Convergence is the grid's north, clockwise from geographic north.
  east_rad_ = convergence * etsi::degree_rad;
  axis_ = direction(east_rad_);
  turn_radpm_ = std::tan(latitude * etsi::degree_rad) / earth_radius_m;
}

// Meridians draw together towards the pole.
double geo_frame::east_rad(point at) const {
  return east_rad_ + turn_radpm_ * dot(axis_, at);
}

geo_position geo_frame::to_wgs84(point at) const {
  const auto local = turned(at, mirrored(axis_));
  double latitude = 0, longitude = 0, height = 0;
  plane_.Reverse(local.x_m, local.y_m, -fall_m(local), latitude, longitude,
                 height);
  return {to_integer(latitude), to_integer(longitude)};
}

std::optional<point> geo_frame::to_map(geo_position position) const {
  if (!position.is_available())
    return {};
  point local;
  double up_m = 0;
  plane_.Forward(position.latitude / per_degree,
                 position.longitude / per_degree, 0, local.x_m, local.y_m,
                 up_m);
  if (std::hypot(local.x_m, local.y_m, up_m) > largest_distance_m)
    return {};
  return turned(local, axis_);
}

point geo_frame::to_map_axes(point east_north, point at) const {
  return turned(east_north, direction(east_rad(at)));
}

point geo_frame::to_east_north(point map_axes, point at) const {
  return turned(map_axes, mirrored(direction(east_rad(at))));
}

int geo_frame::to_etsi_heading(double heading_rad, point at) const {
  return etsi::angle_to_wire(std::numbers::pi / 2 + east_rad(at) - heading_rad);
}

std::optional<double> geo_frame::to_map_heading(int etsi_heading,
                                                point at) const {
  const auto clockwise = etsi::angle_to_rad(etsi_heading);
  if (!clockwise)
    return {};
  return wrap_angle(std::numbers::pi / 2 + east_rad(at) - *clockwise);
}

} // namespace sofof::messages
