// Whether a plan that another computer has made may be followed.
#pragma once

#include "base/objection.hpp"
#include "planners/scene/ego_estimator.hpp"
#include "planners/scene/foreseen_bodies.hpp"
#include "planners/scene/planning_input.hpp"
#include "world/roads/route.hpp"
#include "world/sensing/perception.hpp"
#include "world/vehicle/trajectory.hpp"
#include "world/vehicle/vehicle.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace sofof::planners {

/// A plan, and what the vehicle itself knows about its situation.
struct judged_plan {
  const world::route& way;
  const world::trajectory& plan;   ///< Sound, `s_m` on that route.
  const world::trajectory* in_use; ///< The plan followed until now; null: none.
  const reported_state& own;       ///< The vehicle's motion as it measured it.
  double s_m;                      ///< Its rear axle on the route.
  const world::perception& seen;   ///< By the vehicle, and granted to it.
  bool crossings_granted;          ///< Else drivers judge crossings.
  time_point now;
  /// Of what was received, times left out; 0: none.
  std::uint64_t fingerprint = 0;
  /// What the vehicle's own planner would do from the same state, if it was
  /// asked (`wants_own_plan`), empty if it has none; null: it was not asked.
  const world::trajectory* own_plan = nullptr;
};

/// What a judge says of one plan.
struct plan_verdict {
  bool usable = true; ///< Else the vehicle stays with the plan in use.
  /// Present: the source of the plan is not to be believed any more.
  std::optional<objection> refused{};
  /// Present: why it is of no use, but perhaps no lie.
  std::optional<objection> useless{};
};

/// The limits of `plan_judge`.
struct plan_limits {
  double same_place_m = 1.0; ///< From the vehicle to where a plan begins.
  double same_speed_mps = 1.5;
  double most_age_s = 0.2;
  double own_age_s = 0.2; ///< Who does not know itself better cannot judge.

  double horizon_s = 2.5;    ///< Plans are looked at so far ahead,
  double step_s = 0.1;       ///< in such steps.
  double soon_s = 1.0;       ///< The nearer part of it.
  double later_step_s = 0.5; ///< At least so much apart after that.

  double most_beyond_m = 0.25; ///< The body beyond the lane's edge.
  double most_beyond_soon_m = 0.0;
  double way_back_m = 0.03; ///< A plan that leads back by so much is good.

  double limit_factor = 1.1;    ///< Of the speed limit,
  double above_limit_mps = 0.5; ///< and so much more.
  double slowing_mps2 = 2.5;    ///< More is not asked for before a lower limit.
  double most_along_mps2 = 3.5;
  double most_across_mps2 = 4.5;

  /// Until the own planner brakes in place of a refused plan: two results, one
  /// cycle on board, and the rise of the braking.
  double reaction_s = 0.7;
  double kept_gap_m = 0.5;      ///< While creeping; planners keep 1 m at least.
  double line_decel_mps2 = 4.5; ///< By which it could still stop then.
  /// What can stop now by this does not pass a line unless it wants to.
  double own_line_decel_mps2 = 4.0;
  double beyond_line_m = 0.7;
  double avoiding_mps2 = 5.0; ///< Braking instead of touching a body.

  double hard_mps2 = -4.5;      ///< Braking that needs a reason,
  double hard_soon_s = 0.15;    ///< if it is planned for so soon,
  double longest_hard_s = 0.6;  ///< and goes on for so long.
  double brake_reason_s = 3.0;  ///< A body or line is a reason so near ahead,
  double brake_reason_m = 15.0; ///< and so much nearer or farther.

  double brake_beside_m = 40; ///< Where drivers judge crossings: beside, too.

  double slow_share = 0.9; ///< Of what the way allows.
  double speeding_up_mps = 0.3;
  double speeding_up_mps2 = 0.3;        ///< A vehicle that does so is not slow.
  double comfortable_across_mps2 = 1.8; ///< The way allows so much in bends.
  double waits_beside_m = 60; ///< Where drivers judge crossings, who does not
                              ///< drive may wait for a body so near.
  double compared_every_s = 0.25; ///< With the own plan, while it is slow,
  double compared_over_s = 5.0;   ///< by the way until then,
  double least_way_m = 2.0;       ///< if the own one goes so far.
  double driven_for_s = 1.0;      ///< The same of what is driven meanwhile,
  double least_driven_m = 0.2;    ///< if the own plan went so far.
  double most_lost_s = 1.2;       ///< As if waiting while the own plans drive.
  double forgiven_share = 0.05;   ///< Of the time that passes meanwhile.

  double longest_pause_s = 0.2; ///< Between two results in a row.
  std::size_t remembered = 256; ///< Results.
  double not_back_s = 5.0;      ///< Nobody is back at a place so soon.
  double same_time_s = 0.002;   ///< What begins then is the same plan.
  double moves_mps = 1.0;       ///< Who is slower may be sent a plan again.
};

/// Judges the plans that one provider makes for one vehicle, one after the
/// other, before they are used. A vehicle that refuses a plan goes on with the
/// plan in use, and has its own planner's within 0.15 s; so nothing is refused
/// that can still be mended then, and nothing that is no worse than what the
/// vehicle could do instead.
///
/// * `place`: it begins elsewhere than the vehicle is, or at another speed.
/// * `age`, `length`, `repetition`: it is old, ends within 2.5 s while it
///   drives, or was sent within the last 5 s with other times. Later it may be
///   good again: the vehicle has come round a block.
/// * `road`: the body leaves the lane by much, or a little within a second.
/// * `speed`, `along`, `across`: too fast, or too strong an acceleration.
/// * `stop_line`: soon the vehicle could not stop before the line any more.
/// * `others`: it touches a body, also if the vehicle leaves it soon and
///   brakes, while braking now, or the plan in use, would not. Who creeps
///   touches one ahead half a metre before it.
/// * `braking`: hard, for a while, with nothing ahead. It is obeyed until then:
///   the provider may see a body that the vehicle cannot.
/// * `standing`: while the vehicle is slow, plans stay so far behind what its
///   own planner would do, or lead so much slower, that lost time adds up.
///
/// `place`, `age`, `length`, `repetition` and what cannot be read are refused
/// when two of three results in a row are any of these; `others` and the little
/// of `road` when two of three are so, and who stands or creeps does not follow
/// the first such plan of `others` either; `others` for a body that crosses,
/// and may yet turn, when three are and the own planner would not touch it.
/// Limits: `plan_limits`.
///
/// No heap after the first results.
class plan_judge {
public:
  explicit plan_judge(const world::vehicle_params& car = {}) : car_{car} {}

  plan_verdict judge(const judged_plan& x);

  /// @returns whether `judge` has to know what the own planner would do: the
  /// vehicle is slow, or the last plans have touched a body that crosses. For
  /// plans that are due to be judged now.
  bool wants_own_plan(const judged_plan& x) const;

  /// @returns how far the plan that was judged last, if it is used, stays
  /// within the limits; valid until the next one. Time that is lost or hard
  /// braking without a reason counts up to now.
  std::span<const margin> margins() const {
    return {room_.data(), margin_count_};
  }

  /// A result came that is no plan at all.
  plan_verdict judge_unreadable();

private:
  static constexpr plan_limits limits{};
  static constexpr auto boundless_below =
      -std::numeric_limits<double>::infinity();

  /// Of the latest results, whether they failed a check: the newest first.
  struct history {
    unsigned bits = 0;
    bool add(bool failed); // @returns whether two of three have failed
    bool was_twice() const { return (bits & 0b11) == 0b11; } // just now
    bool all() const { return bits == 0b111; }
  };
  /// What a walk along the plan finds.
  struct walk {
    std::optional<objection> fault; // the first one
    bool leaves_lane = false;       // a little, and soon
    double worst_m = 0;             // beyond the lane, at most
    double beyond_m = 0;            // likewise, soon
    double beside_m = 0;            // the lane's middle, at most
    double over_mps = boundless_below, along_mps2 = boundless_below,
           across_mps2 = boundless_below; // the most
    bool brakes_hard = false;
  };

  /// The beginning of a plan, against the vehicle.
  struct beginning {
    double away_m, faster_mps, age_s;
  };

  static beginning look_at_start(const judged_plan& x);
  std::optional<objection> find_useless(const judged_plan& x,
                                        const beginning& begins);
  void list_margins(const beginning& begins, const walk& found,
                    std::optional<double> beyond_m);
  walk follow(const judged_plan& x) const;
  /// How far beyond a line the vehicle could stop; nothing without one, or if
  /// it cannot stop there whatever the plan.
  std::optional<double> beyond_line_m(const judged_plan& x) const;
  std::optional<foreseen_bodies::touch> touch(const judged_plan& x,
                                              double beside_m);
  std::optional<foreseen_bodies::touch>
  first_touch(const judged_plan& x, const world::trajectory& plan,
              double until_s, double decel_mps2, double kept_gap_m = 0);
  std::optional<objection>
  run_into(const judged_plan& x,
           const std::optional<foreseen_bodies::touch>& touched);
  bool own_plan_touches(const judged_plan& x);
  bool has_reason_to_brake(const judged_plan& x) const;
  std::optional<objection> brake(const judged_plan& x, bool brakes_hard,
                                 double passed_s);
  std::optional<objection> fall_behind(const judged_plan& x, double passed_s);
  bool is_slow(const judged_plan& x) const;
  void compare(const judged_plan& x);
  void settle(const judged_plan& x);
  bool may_wait_beside(const judged_plan& x) const;
  static bool ends_too_soon(const judged_plan& x);
  bool is_repeated(const judged_plan& x);
  double free_speed_mps(const judged_plan& x) const;

  world::vehicle_params car_;
  foreseen_bodies bodies_;
  std::vector<place_in_time> motion_; // room that is used again
  std::vector<std::uint32_t> said_;   // fingerprints, round and round; 0: none
  std::vector<time_point> begins_;    // of the same plans
  std::size_t next_said_ = 0;
  std::optional<time_point> judged_at_; // the last plan
  history unusable_, beside_, near_, crossing_;
  double braking_s_ = 0; // without a reason
  double lost_s_ = 0;    // against the own plans
  std::optional<time_point> compared_at_;
  double driven_lost_s_ = 0; // likewise, by what is driven
  std::optional<time_point> reference_at_;
  double reference_from_m_ = 0;
  world::trajectory reference_; // the own plan of then; room that is used again
  static constexpr std::size_t most_margins = 10;
  std::array<margin, most_margins> room_;
  std::size_t margin_count_ = 0;
};

} // namespace sofof::planners
