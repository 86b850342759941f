// What the tracks on the road mean to one vehicle on its route.
#pragma once

#include "planners/scene/body_footprint.hpp"
#include "planners/scene/corridor.hpp"
#include "planners/scene/crossing_predictor.hpp"
#include "planners/scene/driving_scene.hpp"
#include "planners/scene/known_way.hpp"
#include "planners/scene/opposite_view.hpp"
#include "planners/scene/told_drive.hpp"
#include "planners/scene/track.hpp"
#include "world/vehicle/vehicle.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sofof::planners {

/// How a vehicle looks at the others.
struct scene_params {
  double horizon_m = 200; ///< Ahead of the own front.
  /// To keep on either side of the own body.
  double margin_m =
      (corridor::room_beside_m - world::vehicle_params{}.width_m) / 2;
  bool judges_crossings = false; ///< Else they are granted by somebody else.
  double foresight_s = 10;       ///< Others get so far at their present speed.
  /// Of the own sensor, on the opposite lane; 0: it is never used.
  double sees_opposite_m = 0;
  const line_of_sight* houses = nullptr; ///< Hide it; null: there are none.
  world::vehicle_params car{};
};

/// The vehicle that looks.
struct own_place {
  std::optional<station_id> station; ///< If it is heard by that name.
  double s_m = 0;                    ///< Rear axle on the route, with laps.
  double d_m = 0; ///< Offset from the centre line, left positive.
  double speed_mps = 0;
};

/// Finds out who leads, who stands in the lane, and who crosses. A body is
/// * nobody's business while it stays out of the own lane, whatever its
///   heading;
/// * beside, when it reaches into the lane but leaves room for the own body
///   and both margins on one side; once it has been that, with a little less
///   room too, and with 0.3 m beside the own body when there is no way to stop
///   before it any more; or room enough with the opposite lane, if it stands
///   there by itself and that is free for long enough;
/// * the lead, when it is the nearest that reaches into the way of the own
///   body (and margins) on the centre line, and leaves no such room; bodies
///   beyond it are not looked for;
/// * crossing, when crossings are judged and it is on, or drives towards, the
///   other side of a zone ahead. Who drives across the own way there is
///   not a lead besides, and who drives along it is not crossing. Whoever
///   comes first to a zone that the own front is on already counts where it
///   will be in a moment, too.
class scene_interpreter {
public:
  /// @param way  Not null.
  scene_interpreter(known_way_ptr way, scene_params params);

  /// Describes all but `stop_at_m`, which it leaves as it is: what is granted
  /// is not seen.
  /// * The lead: its speed along the own way, 0 when it comes; its
  ///   acceleration only when it brakes; its station 0 when unknown.
  /// * Crossings: who goes first, see `crossing_predictor::judge`.
  /// @param tracks  At most as new as `now`; the own one may be among them
  ///                and is known by its station or its place.
  /// @param out     Its vectors are reused.
  /// @param told    What others that take part say; those that do are not
  ///                judged by what is seen of them.
  void describe(time_point now, const own_place& me,
                std::span<const track> tracks, driving_scene& out,
                std::span<const told_drive> told = {});

private:
  struct near { // part of the way
    double low_m, guess_m;
    std::size_t who;
  };
  double reach_of(const track& x) const;
  double stands_s(time_point now, const own_place& me);
  void gather(time_point now, const own_place& me,
              std::span<const track> tracks);
  void keep_to_lane(const track& known, time_point now, track& x) const;
  void foresee_cutting_in();
  void find_near(const own_place& me);
  std::optional<body_footprint> measure(const track& x, double guess_m) const {
    return measure_body(route(), x, {guess_m, way_->bead_m, corridor_m()});
  }
  std::optional<body_footprint> measure_met(const own_place& me,
                                            const near& where,
                                            const body_footprint& b) const;
  std::optional<body_footprint> measure_ahead(const own_place& me,
                                              const near& where) const;
  lead_vehicle leading(const own_place& me, const track& x,
                       const body_footprint& b, double pull_out_m) const;
  std::optional<lane_obstacle> look_past_lead(const own_place& me,
                                              const track& x,
                                              const body_footprint& b,
                                              const lead_vehicle& lead) const;
  void add_swing(body_footprint& b) const;
  void find_bodies(const own_place& me, driving_scene& out);
  const world::route& route() const { return *way_->route(); }
  double corridor_m() const {
    return params_.car.width_m / 2 + params_.margin_m;
  }
  bool has_to_pass(const own_place& me, const track& x,
                   const body_footprint& b) const;
  bool blocks_alone(const own_place& me, const near& where,
                    const body_footprint& b,
                    std::span<const way_stretch> keep_free) const;
  bool has_time(const own_place& me, const near& where,
                const body_footprint& b);

  known_way_ptr way_;
  scene_params params_;
  crossing_predictor crossings_;
  // Of one call, like `near_` and `coming_`.
  std::vector<other_body> others_;
  std::size_t seen_ = 0; // of them; the rest is where those who cut in will be
  std::vector<near> near_;
  std::vector<std::uint32_t> beside_, were_beside_; // their tracks, sorted
  std::uint32_t looks_past_ = 0; // the track that it waits behind
  std::vector<oncoming_body> coming_;
  std::optional<time_point> stands_since_;
};

} // namespace sofof::planners
