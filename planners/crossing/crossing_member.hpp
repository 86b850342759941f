// A vehicle's part at a crossing that somebody conducts: what it is advised,
// what it claims, what it hears, and what its planner has to keep to.
#pragma once

#include "planners/crossing/claim_book.hpp"
#include "planners/scene/told_drive.hpp"
#include "world/vehicle/trajectory.hpp"
#include "world/vehicle/vehicle.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace sofof::planners {

/// What a planner has to know of it.
struct crossing_view {
  world::trajectory drive; ///< To keep to; empty: own rules.
  double line_m = 0;       ///< Its front waits there until the drive binds.
  bool binds = false;
  std::vector<told_drive> told; ///< By all others that take part.
};

/// What others tell is left out: it stays in the vehicle.
void visit_fields(auto& v, crossing_view& x) {
  v("drive", x.drive);
  v("line_m", x.line_m);
  v("binds", x.binds);
}

/// Claims a drive shortly before it enters the crossing, holds it while it is
/// kept, and gives it up as long as the vehicle can stop if it will not be.
class crossing_member {
public:
  struct rules {
    claim_book::rules claims;
    duration claims_before = std::chrono::milliseconds{4500}; ///< It enters.
    duration told = std::chrono::seconds{28}; ///< Of a drive, at most.
    duration advice_holds = std::chrono::milliseconds{150};
    double late_s = 0.35; ///< Later or sooner than its drive, it gives it up.
    /// Others that are farther away do not matter, unless both are so fast that
    /// they may claim there already.
    double near_m = 150;
  };

  crossing_member(station_id me, const world::vehicle_params& car)
      : crossing_member(me, car, rules{}) {}
  crossing_member(station_id me, const world::vehicle_params& car, rules r);

  /// Where the vehicle is.
  struct place {
    double s_m = 0; ///< Rear axle on its route, laps included.
    double speed_mps = 0;
    double line_m = 0;  ///< Its front comes to the crossing there, ...
    double clear_m = 0; ///< ... and its rear has left it here.
    point at;
    const world::trajectory* plan = nullptr; ///< In use; null: none.
  };

  /// A drive was suggested. Sound, along its route.
  void advise(time_point now, const world::trajectory& drive);

  /// Nobody advises any more: what it has claimed it keeps.
  void end_advice() { advised_.reset(); }

  /// Another one tells of itself.
  /// @param from  Where its front is.
  void on_report(time_point now, const crossing_claim& told,
                 const claimed_drive& plan, point from);

  /// The vehicle is here now.
  void move(time_point now, const place& own);

  /// @returns what it tells everybody now.
  crossing_claim tell(time_point now) const { return book_.tell(now); }

  /// A claim that is over.
  struct past_claim {
    time_point claimed;
    std::optional<time_point> bound;
    time_point enters, leaves; ///< The crossing.
    bool was_kept = false;     ///< Else it was given up.
  };

  /// @returns the claim that ended since the last call.
  std::optional<past_claim> take_past() { return std::exchange(past_, {}); }

  /// @returns how it is going to drive; null: by its own rules.
  const world::trajectory* drive() const;

  claim_book::state state() const { return book_.is(); }

  /// @param out  Its room is used again.
  void look(time_point now, crossing_view& out) const;

private:
  struct advice {
    world::trajectory drive;
    time_point until;
  };
  bool can_stop() const;
  bool is_kept(time_point now, const world::trajectory& drive) const;
  bool is_behind(time_point now, const world::trajectory& drive) const;
  bool is_before(time_point now, const world::trajectory& drive) const;
  claimed_drive claim_of(const world::trajectory& drive) const;
  bool is_near(const claimed_drive& plan, point from) const;
  std::optional<time_point> enters(const world::trajectory& drive) const;
  void claim(time_point now, const world::trajectory& drive);
  void follow_claim(time_point now);

  station_id me_;
  world::vehicle_params car_;
  rules rules_;
  claim_book book_;
  std::optional<advice> advised_;
  world::trajectory claimed_; // what the claim is of
  std::optional<past_claim> present_, past_;
  double claimed_line_m_ = 0, claimed_clear_m_ = 0;
  std::optional<double> done_m_; // the line that it has passed by a claim
  place own_;
  struct heard {
    told_drive is;
    time_point at;
  };
  std::vector<heard> told_; // by station
};

} // namespace sofof::planners
