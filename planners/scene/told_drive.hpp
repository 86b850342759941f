// How a vehicle is going to drive, as it tells everybody.
#pragma once

#include "base/geometry.hpp"
#include "base/ids.hpp"
#include "base/time.hpp"

#include <optional>
#include <vector>

namespace sofof::planners {

/// Where a vehicle's body is, moment by moment, from before the first place
/// that others use to behind the last one. What it claims is each of its
/// places for as long as its body is there, and a little before and after.
struct claimed_drive {
  time_point from; ///< Of the first of the bodies.
  duration step{}; ///< Between two of them; > 0.
  std::vector<oriented_box> bodies;

  bool empty() const { return bodies.empty(); }

  /// @returns when its body is at the last of the places.
  time_point to() const {
    return from + step * (static_cast<duration::rep>(bodies.size()) - 1);
  }

  /// @returns its body then; at the ends as there. Not empty.
  oriented_box at(time_point t) const;
};

/// @returns whether two bodies touch, if the second one comes up to `apart`
/// later or earlier than it is going to.
bool overlap(const claimed_drive& a, const claimed_drive& b, duration apart);

/// Who is farther behind its claim than this gives it up, and nobody counts on
/// it any more. Well below what lies between two claims (claim_book::rules).
double most_behind_m(double speed_mps);

/// What a vehicle tells everybody about itself at a crossing.
struct crossing_claim {
  station_id who = 0;
  time_point generated;               ///< By its own clock, as its drive.
  std::optional<claimed_drive> drive; ///< None: it claims nothing.
};

/// What another vehicle that takes part says of its drive.
struct told_drive {
  station_id who = 0;
  claimed_drive drive;     ///< Empty: it says nothing of it.
  bool is_claimed = false; ///< Nobody else comes there meanwhile.
  point front{};           ///< Where its front was when it said so.
};

} // namespace sofof::planners
