// A place where a channel is worse, or better, than elsewhere.
#pragma once

#include "base/geometry.hpp"
#include "base/options/option_visitor.hpp"
#include "base/time.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sofof::channel {

/// What a place changes in a channel.
struct place_quality {
  duration more_delay{};   ///< Of any message, one way.
  double delay_factor = 1; ///< Delays of the network are so many times as long.
  double loss = 0;         ///< Probability in [0, 1] for each message, besides.

  /// @returns a delay of the network as it is there.
  duration slowed(duration delay) const;

  friend bool operator==(const place_quality&, const place_quality&) = default;
};

/// Where messages that a vehicle sends or gets take longer or are lost: what
/// counts is where it is when they are sent.
struct network_area {
  std::string name;
  std::vector<point> area_m;       ///< A polygon, m, east-north;
  std::optional<point> position_m; ///< or the middle of a circle
  double radius_m = 100;           ///< with this radius.
  place_quality quality;

  /// Any rim counts as inside.
  bool contains(point p) const;

  void visit_options(option_visitor& s);

private:
  polygon shape_; // of area_m
};

/// @returns what all areas round a place make of it together: delays add up,
/// factors multiply, and what one lets through another may lose.
place_quality quality_at(std::span<const network_area> areas, point place);

} // namespace sofof::channel
