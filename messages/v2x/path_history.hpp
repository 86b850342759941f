// Where a vehicle has been, in few points: for the CAM's path history.
#pragma once

#include "base/geometry.hpp"
#include "base/time.hpp"

#include <array>
#include <cassert>
#include <cstddef>

namespace sofof::messages {

/// The last 200 m of a vehicle's way as few points: the way was never farther
/// than 0.47 m from the straight lines between them, and they stand no more
/// than 22.5 m apart. Ten of them reach back about 200 m where the road is
/// straight. Needs no heap.
///
/// Source: the concise points of SAE J2945/1, appendix A, with the error and
/// the distances of the CAR 2 CAR Basic System Profile; but what lies between
/// two points is looked at, not estimated from the change of heading.
class path_history {
public:
  /// Of PathHistory, TS 102 894-2.
  static constexpr std::size_t capacity = 40;

  struct place {
    point at;        ///< m, east-north.
    time_point when; ///< For its age.
  };

  /// @param most  Points, 1 to `capacity`.
  explicit path_history(std::size_t most = 10);

  /// Tells where the vehicle is; the more often, the truer the points.
  /// @param now  Later than the time before.
  void pass(time_point now, point position);

  /// How many points there are; the place of now is none of them.
  std::size_t size() const { return size_; }

  /// @param i  < size(); 0 is the newest.
  const place& operator[](std::size_t i) const {
    assert(i < size());
    return kept_[(newest_ + capacity - i) % capacity];
  }

private:
  bool is_needed(point next) const;
  void keep(const place& x);
  void drop_what_is_far();

  std::size_t most_;
  std::array<place, capacity> kept_{}; // a ring
  std::size_t newest_ = 0, size_ = 0;
  std::array<place, 32> since_{}; // the newest point, in order of time
  std::size_t since_size_ = 0;
};

} // namespace sofof::messages
