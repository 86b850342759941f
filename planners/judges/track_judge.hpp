// Whether what another computer tells of the bodies round a vehicle may be
// used.
#pragma once

#include "base/objection.hpp"
#include "planners/judges/lasting_doubt.hpp"
#include "planners/plausibility/witness.hpp"
#include "planners/scene/line_of_sight.hpp"
#include "planners/scene/object_tracker.hpp"

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace sofof::planners {

/// What is told of the others, and what the vehicle has seen itself.
struct judged_tracks {
  time_point now;
  time_point at; ///< When the bodies were where they are told to be.
  std::span<const world::perceived_object> told;
  std::span<const std::uint32_t> ids; ///< Of each: the same as long as known.
  road_look look;                     ///< The vehicle's newest, of all it sees.
};

/// What a judge says of one list of tracks.
struct track_verdict {
  /// Present: who tells this is not to be believed any more.
  std::optional<objection> refused{};
  /// Present: why it is of no use, but perhaps no lie.
  std::optional<objection> useless{};
};

/// The limits of `track_judge`.
struct track_limits {
  double most_age_s = 0.5;
  double look_age_s = 0.3; ///< Who has not looked for longer cannot judge.

  double ample_m = 30;      ///< Bodies matter so near, ...
  double calmly_mps2 = 3;   ///< ... and within the way of braking by this.
  double known_for_s = 0.4; ///< So long a body is seen until it is missed,
  double added_for_s = 0.2; ///< and so long until it is added.

  double along_m = 1.2;  ///< One body, told and seen, is no farther apart,
  double across_m = 0.7; ///< along it and across.
  double speed_mps = 2.0;
  double drift_mps2 = 4.0; ///< What may have changed between the two moments.
  double length_m = 0.6;
  double width_m = 0.35;
  double near_m = 6.0; ///< A body that is told so near may be this one, moved.

  double mean_m = 0.35;    ///< One body, told and seen, on average.
  double mean_share = 0.1; ///< Of the newest look in that average.
  int mean_of = 8;         ///< Looks at least.
  double slow_mps = 2.0;   ///< The average counts for who drives no faster.

  double most_speed_mps = 60;
  double most_accel_mps2 = 14;
  double most_length_m = 55;
  double most_width_m = 12;
  double jump_m = 4.0;   ///< More than speed and braking explain.
  double renamed_m = 60; ///< So near a new number may be of a known body
  double same_way = 0.9; ///< that drives so, cosine.

  double doubt_s = 1.0;          ///< So long a doubt has to last.
  double longest_pause_s = 0.25; ///< Between two results in a row.
};

/// Judges the tracks that one provider tells one vehicle, result after result.
/// What the vehicle's own sensors see is not to be lost: bodies that they see
/// and that are told wrongly or not at all are `besides`, from the first result
/// on, whether that is an honest mistake or a lie. A lie is what lasts:
///
/// * `missing`: a body has been seen for 0.4 s, matters, and is not told.
/// * `shifted`: the same, and another one is told near it; or a slow one is
///   told beside its place by 0.35 m on average; or one is told to move
///   otherwise than it does, or to be smaller.
/// * `added`: a body is told where the vehicle looks freely, now and 0.3 s
///   before, and sees none.
/// * `jump`: a body is where its own motion does not lead; near the vehicle by
///   another number, too.
/// * `limits`: no road user is so fast, speeds up or brakes so hard, or is so
///   large.
///
/// Bodies matter within 30 m and within the way in which the vehicle could
/// stop calmly. One second of doubt in all is refused; time without doubt takes
/// half as much off. What holds for a moment more than 0.5 s ago is left out
/// (`age`). What is told of places that the vehicle cannot see is believed.
class track_judge {
public:
  /// @param noise   Of the own sensor.
  /// @param houses  Hide what is behind them; not null.
  track_judge(const sighting_noise& noise,
              std::shared_ptr<const line_of_sight> houses);

  track_verdict judge(const judged_tracks& x);

  /// @returns the bodies of the last look that matter and are not told as they
  /// are; valid until the next result.
  std::span<const world::perceived_object> besides() const { return besides_; }

  /// @returns how much more doubt would be too much, s.
  double left_s() const { return doubt_.left_s(); }

private:
  static constexpr track_limits limits{};

  struct past_look {
    time_point at;
    std::vector<world::perceived_object> seen;
  };
  /// Told and seen, of one body.
  struct offset {
    point of; // where it was seen last
    double along_m, across_m;
    int looks;
    time_point at;
  };
  /// How a told body fits a seen one.
  struct comparison {
    double along_m, across_m, speed_mps;
    bool in_place, alike;

    double off_m() const { return std::hypot(along_m, across_m); }
    bool fits() const { return in_place && alike && off_m() < limits.mean_m; }
  };

  double matters_m(const judged_tracks& x) const;
  comparison compare(const world::perceived_object& seen, point axis,
                     const world::perceived_object& told, double apart_s) const;
  std::string_view look_for_seen(const judged_tracks& x);
  std::string_view look_for_told(const judged_tracks& x, double matters_m);
  std::string_view find_impossible(const judged_tracks& x);
  bool jumps_by_another_number(point from, double passed_s) const;
  const past_look* look_before(time_point t) const;
  static bool was_there(const past_look& then,
                        const world::perceived_object& body, time_point at);
  bool is_off_on_average(const world::perceived_object& seen,
                         const comparison& how, time_point at);
  void remember(const judged_tracks& x, double matters_m);

  sighting_noise noise_;
  double worse_m_; // than a good sensor, standard deviation
  std::shared_ptr<const line_of_sight> houses_;
  witness own_;
  lasting_doubt doubt_{limits.doubt_s};
  std::optional<time_point> judged_at_;
  std::vector<past_look> past_; // the newest last
  std::vector<offset> offsets_;
  std::vector<world::perceived_object> besides_;
  // Of the last result, and of this one: told bodies in order of their ids.
  time_point told_at_;
  std::vector<std::pair<std::uint32_t, world::perceived_object>> told_before_,
      told_now_;
  // Room that is used again: told bodies at the moment of the look.
  std::vector<world::perceived_object> told_;
};

} // namespace sofof::planners
