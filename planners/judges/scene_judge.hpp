// Whether what another computer makes of the bodies round a vehicle, on the
// vehicle's own way, may be used.
#pragma once

#include "base/objection.hpp"
#include "planners/judges/lasting_doubt.hpp"
#include "planners/plausibility/witness.hpp"
#include "planners/scene/corridor.hpp"
#include "planners/scene/driving_scene.hpp"
#include "planners/scene/line_of_sight.hpp"
#include "planners/scene/object_tracker.hpp"
#include "planners/scene/track.hpp"
#include "world/roads/route.hpp"
#include "world/vehicle/vehicle.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace sofof::planners {

/// What a vehicle itself knows of its scene, at the moment of one that is told.
struct own_knowledge {
  time_point now;
  const world::route& way;
  double s_m = 0; ///< Its rear axle.
  double speed_mps = 0;
  const driving_scene& scene;        ///< Of its own map and tracks.
  std::span<const track> tracks;     ///< Of which that was made.
  road_look look;                    ///< The newest of its sensor.
  std::optional<double> stop_at_m{}; ///< It has to stop there anyway.
};

/// What a judge says of one scene.
struct scene_verdict {
  /// Present: who tells this is not to be believed any more.
  std::optional<objection> refused{};
};

/// The limits of `scene_judge`.
struct scene_limits {
  double ample_m = 30;    ///< What is ahead matters so near, ...
  double calmly_mps2 = 3; ///< ... and within the way of braking by this.

  double along_m = 2.0;     ///< A lead, told and known, is no farther apart.
  double for_speed_s = 0.2; ///< The same for each m/s of it.
  double faster_mps = 2.5;
  double pulls_out_m = 11.5; ///< A lead is told before its body by so much.
  double beside_m = 0.35;    ///< The side of a body, told and known.
  double widened_m = 0.15;   ///< From so much on the more cautious counts.
  double touches_m = 0.1;    ///< Who is so near a car on its line matters.
  double most_lacking_m = 0.3;
  double crossing_m = 3.0;     ///< A stretch that others cross, told and known,
  double crossing_s = 1.5;     ///< and when.
  double foresight_s = 5.0;    ///< Who comes later may yet turn.
  std::size_t most_minded = 4; ///< Who cross: planners mind no more of them,
  std::size_t most_places = 16; ///< and no more places.
  double here_s = 0.5;          ///< Who is on the stretch.
  double map_m = 1.5;           ///< Where a crossing begins or ends.
  double map_from_m = 3.0;      ///< Ahead of the front bumper, looked at from
  double map_to_m = 120;        ///< and to there.

  double corridor_m = corridor::room_beside_m / 2; ///< Beside the line.
  double looked_for_m = 20;       ///< Bodies, from where they are told to be.
  double lead_speeds_up_mps2 = 3; ///< That drives as it tells.

  double most_speed_mps = 60;
  double most_accel_mps2 = 14;

  double doubt_s = 1.0;          ///< So long a doubt has to last.
  double longest_pause_s = 0.25; ///< Between two results in a row.
  double waits_mps = 1.0;        ///< Who is slower waits,
  double waits_m = 20;           ///< if there is a reason so near,
  double most_waited_s = 12;     ///< that it does not know of, for so long.
};

/// Judges the scenes that one provider tells one vehicle, result after result.
/// What the vehicle knows itself is not to be lost: of what is told and what is
/// known, the more cautious is used from the first result on. A lie is what
/// lasts:
///
/// * `lead`, `beside`, `crossing`: a body that the vehicle knows, and that is
///   in its way, is not told, or is told farther, faster, farther beside,
///   later, or as one that gives way.
/// * `map`: crossings are told where the own map has none, or none where it has
///   one.
/// * `added`: something is told to be on the way where the vehicle looks
///   freely, now and 0.3 s before, and sees none.
/// * `waits`: the vehicle has waited for 12 s for what it does not know of.
/// * `limits`: no road user is so fast, or speeds up or brakes so hard.
///
/// Matters what is within 30 m and the way in which the vehicle could stop
/// calmly. One second of doubt in all is refused; time without doubt takes half
/// as much off. What is told of places that the vehicle cannot see is believed.
class scene_judge {
public:
  /// @param noise  Of the own sensor: what is known is as uncertain.
  explicit scene_judge(const world::vehicle_params& car = {},
                       const sighting_noise& noise = {});

  /// @param houses  Of the map.
  /// @param told    Is made as cautious as what is known.
  scene_verdict judge(const own_knowledge& x, const line_of_sight& houses,
                      driving_scene& told);

  /// @returns how much more doubt would be too much, s.
  double left_s() const { return doubt_.left_s(); }

private:
  static constexpr scene_limits limits{};

  static bool meet(double a_from_m, double a_to_m, double b_from_m,
                   double b_to_m, double slack_m) {
    return a_from_m <= b_to_m + slack_m && b_from_m <= a_to_m + slack_m;
  }

  double front_m(const own_knowledge& x) const { return x.s_m + car_.front_m; }
  double matters_to_m(const own_knowledge& x) const;
  static std::string_view find_impossible(const driving_scene& told);
  std::string_view hold_to_map(const own_knowledge& x,
                               driving_scene& told) const;
  bool leads_before(const own_knowledge& x, double at_m, double speed_mps,
                    const driving_scene& told) const;
  bool leads_from(const own_knowledge& x, const crossing_user& own,
                  const driving_scene& told) const;
  double gone_s(const own_knowledge& x, double at_m, double to_m) const;
  bool crosses_as(const own_knowledge& x, const way_stretch& place,
                  double off_m, const driving_scene& told) const;
  bool is_passed(const own_knowledge& x, double at_m,
                 const driving_scene& told) const;
  std::string_view hold_to_lead(const own_knowledge& x,
                                driving_scene& told) const;
  bool hold_body(const own_knowledge& x, const lane_obstacle& own,
                 lane_obstacle& told) const;
  std::string_view hold_to_beside(const own_knowledge& x,
                                  driving_scene& told) const;
  static bool crosses_like(const crossing_user& own, const crossing_user& told);
  bool matters(const own_knowledge& x, const crossing_user& own) const;
  void leave_out_far(const own_knowledge& x, driving_scene& told) const;
  static bool is_crowded(std::span<const crossing_user> users);
  static void sort_crossings(driving_scene& x);
  std::string_view hold_to_crossings(const own_knowledge& x,
                                     driving_scene& told) const;
  bool is_known_at(const own_knowledge& x, double from_m, double to_m) const;
  bool is_seen_empty(const own_knowledge& x, const line_of_sight& houses,
                     double at_m) const;
  std::string_view find_added(const own_knowledge& x,
                              const line_of_sight& houses,
                              const driving_scene& told) const;
  std::string_view wait(const own_knowledge& x, const driving_scene& told,
                        double passed_s);

  world::vehicle_params car_;
  double uncertain_m_; // of the sides of bodies, beyond a good sensor's
  witness own_;
  std::optional<time_point> looked_at_, judged_at_;
  lasting_doubt doubt_{limits.doubt_s};
  double waited_s_ = 0;
};

} // namespace sofof::planners
