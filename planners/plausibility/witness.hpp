// Somebody who looks at the road and tells what is there: what it would have
// told, had it been there.
#pragma once

#include "planners/plausibility/motion_check.hpp"
#include "planners/scene/line_of_sight.hpp"
#include "planners/scene/track.hpp"
#include "world/sensing/viewpoint.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sofof::planners {

/// What one look at the road gave.
struct road_look {
  time_point at;         ///< When `from` and `in_sight` held.
  world::viewpoint from; ///< Range 0: as it was told last.
  double speed_mps = 0;  ///< Of the sensor, along its heading.
  time_point seen_at;    ///< When the bodies were where they are said to be.
  std::span<const world::perceived_object> seen; ///< That are told of.
  /// Their numbers, the same from look to look; none of a sensor's, which
  /// tells at each look of all that it sees.
  std::optional<std::span<const std::uint32_t>> ids;
  std::size_t in_sight = 0; ///< All that is seen, told of or not.
};

/// A sensor at the roadside, or a vehicle that sends CPMs. A CPM tells of the
/// objects that are due, each at least once a second, and of how many there
/// are in all: only when all of them are known is a place known to be empty.
class witness {
public:
  void look(const road_look& l);

  time_point at() const { return at_; }

  /// @returns whether a body is round it: its own, seen by others.
  bool stands_in(const track& x) const;

  enum class sight : std::uint8_t {
    nothing, ///< There is no body in the place of this one, ...
    another, ///< ... one that moves otherwise, ...
    same,    ///< ... or one that moves like it.
  };
  /// @returns what it tells of the place of a body.
  sight look_at(const track& x) const;

  /// @returns whether a body would have been told of that has been there for
  /// 0.3 s: both then and now it is well within range and field of view, its
  /// front, middle or rear lies open, and all that is seen is known.
  bool overlooks(const track& x, const line_of_sight& houses) const;
  bool overlooks(const timed_body& x, const line_of_sight& houses) const;

  /// @returns whether all that it tells of is still in sight: told of in the
  /// last look, or well in view. Else one of them may have gone, and another
  /// one counts in its place of which no message has come yet.
  bool is_sure(const line_of_sight& houses) const;

  /// @returns whether the last look, made before anybody told of the body,
  /// would have shown it where it must have been then: it lay open, however it
  /// has sped up or slowed down since.
  bool overlooked(const track& x, const line_of_sight& houses) const;

  /// @returns whether it would see this body at `now`; late by 0.1 s.
  bool would_see(const track& x, const line_of_sight& houses,
                 time_point now) const;

private:
  struct told_body {
    std::uint32_t id;
    timed_body is;
  };
  /// @param self  Which of what it tells of this is, if any.
  bool is_open(const world::perceived_object& body, const line_of_sight& houses,
               time_point t, const told_body* self = nullptr) const;

  time_point at_;
  time_point seen_at_;
  world::viewpoint from_;
  double speed_mps_ = 0;
  bool is_complete_ = false;
  std::vector<told_body> told_; // not longer ago than they are due again
};

} // namespace sofof::planners
