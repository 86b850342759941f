// The lanes of a map as bodies drive on them: who is on which lane, and which
// conflicts it drives towards.
#pragma once

#include "base/frozen_cells.hpp"
#include "planners/scene/track.hpp"
#include "world/roads/conflict_side.hpp"
#include "world/roads/path.hpp"
#include "world/roads/road_map.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sofof::planners {

/// When a body is on one side of a conflict, if its speed stays as it is; who
/// is slow may come there sooner, as if it sets off.
struct conflict_visit {
  std::uint32_t side = 0;    ///< As in `conflict_side`.
  int rank = 0;              ///< Of its lane.
  double way_m = 0;          ///< From its front to the stretch; 0: on it.
  double enter_s = 0;        ///< Its front comes onto the stretch; 0: on it.
  double leave_s = 0;        ///< Its rear leaves; infinite: it stands there.
  bool sets_off = false;     ///< If it does: it stands before the stretch.
  bool is_past = false;      ///< Its middle has left the stretch.
  bool may_turn_off = false; ///< There is another way for it before that.
};

/// Lanes, how they follow each other, and their conflicts; immutable, one for
/// all vehicles on a map.
class lane_network {
public:
  static constexpr double farthest_m = 300;
  /// Who stands no farther than this before a conflict may set off, m.
  static constexpr double at_line_m = 8;

  explicit lane_network(const world::road_map& map);

  const world::conflict_sides& meetings() const { return meetings_; }

  /// @returns the lanes that begin where one ends, and that end where it
  /// begins.
  std::span<const std::size_t> next(std::size_t lane) const {
    return next_[lane];
  }
  std::span<const std::size_t> previous(std::size_t lane) const {
    return previous_[lane];
  }

  /// @returns the right of way of a conflict's side.
  int rank(std::uint32_t side) const { return ranks_[side]; }

  /// @returns the roundabout that the lane of a conflict's side is part of, by
  /// its number; nullopt if there is none.
  std::optional<std::size_t> roundabout(std::uint32_t side) const {
    return rounds_[side];
  }
  bool is_on_roundabout(std::uint32_t side) const {
    return rounds_[side].has_value();
  }

  /// How a lane comes to a conflict and goes through it.
  struct course {
    double from_rad = 0; ///< Its direction shortly before.
    double turn_rad = 0; ///< How it has turned at the end, left positive.
  };
  course course_of(std::uint32_t side) const { return courses_[side]; }

  /// @returns places on the way of those who come to a conflict's side, from
  /// where it begins back, 4 m apart, as far as one gets at the lanes' speed
  /// limits in that time.
  std::vector<point> approach(std::uint32_t side, double within_s) const;

  /// Where a body is on a lane that it drives along.
  struct placement {
    std::size_t lane = 0; ///< Index into the map's lanes.
    double s_m = 0;       ///< Of its centre, arc length on that lane.
  };

  /// Up to this many lanes; where more lie on top of each other, the first in
  /// the order of the map.
  struct placements {
    std::array<placement, 8> all;
    std::size_t count = 0;

    auto begin() const { return all.begin(); }
    auto end() const { return all.begin() + count; }
  };

  /// @returns the lanes that a body's centre is on and that run its way (to
  /// within 45°), in the order of the map; several where lanes begin, end or
  /// cross.
  placements find(const oriented_box& body) const;

  /// Appends the conflicts that a body is on or drives towards, on whatever
  /// lanes it may take; each side once, with the earliest entry and the latest
  /// exit of all ways; but for those with bends that it is too fast for. Who
  /// stands is thought to set off at once, if it is at
  /// most `at_line_m` away.
  /// @param within_m  How far its front looks, m, at most `farthest_m`.
  void foresee(const track& x, double within_m,
               std::vector<conflict_visit>& out) const;

  /// @returns a body as it will be after so long a way: along the lane that it
  /// keeps to best, at its distance from that; straight on where it is on none,
  /// and behind the lane's end.
  track moved_along(track x, double way_m) const;

private:
  struct piece {
    point from, to;
    double s_m; // of its middle
    std::uint32_t lane;

    bool reaches(point p) const;
  };
  struct driver; // on its way
  void cut();
  struct bend {            // where a lane is sharpest
    double s_m, speed_mps; // and how fast anybody drives there
  };
  bool stays_on(const track& x, const placement& on) const;
  bool takes(const driver& who, std::size_t lane, double start_m) const;
  void come(std::size_t lane, double s_m, double within_s,
            std::vector<point>& out) const;
  /// A lane on a body's way.
  struct lane_ahead {
    std::size_t lane;
    double start_m;    ///< From the body's centre on.
    bool may_turn_off; ///< There was another one to choose.
  };
  void meet(const driver& who, const lane_ahead& on) const;
  void drive(const driver& who, const lane_ahead& on) const;

  world::conflict_sides meetings_;
  std::vector<int> ranks_;                         // of all sides
  std::vector<std::optional<std::size_t>> rounds_; // likewise
  std::vector<placement> begins_;                  // likewise, where they begin
  std::vector<bend> bends_;                        // of each lane
  std::vector<course> courses_;                    // of all sides
  std::vector<world::path> paths_;
  std::vector<double> half_widths_m_, limits_mps_;
  std::vector<std::vector<std::size_t>> next_, previous_; // of each lane
  frozen_cells<piece> pieces_; // as wide as the lanes
};

} // namespace sofof::planners
