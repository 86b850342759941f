// How much of a source is believed.
#pragma once

#include "base/geometry.hpp"

#include "maps/xml_file.hpp"
#include <cstddef>
#include <span>
#include <unordered_map>

namespace sofof::maps {

/// Longer lanes are mistakes, m.
inline constexpr auto longest_lane_m = 20e3;

/// A line of more points is no lane's.
inline constexpr std::size_t most_points = 10'000;

/// So many lanes at most follow one, and so many lead to one.
inline constexpr std::size_t most_links = 64;

/// Counts what a reader makes of a file, and refuses, with the place, what no
/// network of roads has: it would take hours, or all memory.
class road_limits {
public:
  explicit road_limits(const xml_file& file) : file_{file} {}

  /// A line of a lane. @throws input_error if it, or all lines so far, are too
  /// long or have too many points.
  void count_line(pugi::xml_node at, std::span<const point> line);

  /// One lane follows another, both by number. @throws input_error when there
  /// are too many others.
  void count_link(pugi::xml_node at, std::size_t from, std::size_t to);

private:
  const xml_file& file_;
  double all_m_ = 0;
  std::size_t all_points_ = 0;
  std::unordered_map<std::size_t, std::size_t> after_, before_;
};

} // namespace sofof::maps
