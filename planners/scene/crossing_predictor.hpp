// Who crosses the own way, when, and who goes first: judged by what is seen.
#pragma once

#include "planners/scene/driving_scene.hpp"
#include "planners/scene/known_way.hpp"
#include "planners/scene/lane_network.hpp"
#include "planners/scene/track.hpp"
#include "world/roads/unrolled_route.hpp"

#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

namespace sofof::planners {

/// Another road user, at the present.
struct other_body {
  track x;
  bool is_crossing = false; ///< On or before a zone ahead of the own front.
  bool cuts_in = false; ///< It comes first to a zone that the own front is on.
  /// It has claimed the drive on which it is, or waits for that to bind; the
  /// latter only as long as it can stay off the own way.
  bool has_claimed = false, takes_part = false;
};

/// The vehicle that judges, on its route.
struct crossing_viewer {
  std::optional<station_id> station; ///< If it is heard by that name.
  double rear_m = 0, front_m = 0;    ///< Its bumpers, arc length.
  double speed_mps = 0;
  bool is_impatient = false; ///< As in `driving_scene`.
};

/// @param cosine  Of the angle between a body and a way.
/// @returns whether the body drives along it: to within 45°.
inline bool is_along(double cosine) {
  return cosine > std::numbers::sqrt2 / 2;
}

/// Judges the crossings of one route.
class crossing_predictor {
public:
  /// @param way         Not null.
  /// @param corridor_m  Whoever is within this of the centre line and drives
  ///                    along is not crossing.
  /// @param foresight_s Others get so far at their present speed.
  crossing_predictor(known_way_ptr way, double corridor_m, double foresight_s);

  /// Finds the zones of the own way that the vehicle has not left and that
  /// begin before `to_m`.
  /// @param keep_free  Them, joined where no car fits between; those that begin
  ///                   before the front and those behind it stay apart, and
  ///                   may overlap.
  void look_ahead(double rear_m, double front_m, double to_m,
                  std::vector<way_stretch>& keep_free);

  /// Finds everybody on the other side of each of these zones, or on the way
  /// there. Marks those who cross.
  ///
  /// Who goes first: whoever is on the zone, or cannot stop before it any more;
  /// then the lower rank; of equal ones who is on a roundabout; who comes from
  /// the right, or goes straight on where the other turns left; else the lower
  /// station; else the other. Who stands before a zone may set off as long as
  /// it has not stood there for too long: each vehicle waits for another time,
  /// so that not all set off at once, and for longer if the other has the
  /// better rank; who has stood for long itself waits for nobody who stands.
  /// Who stands on a zone is not crossing: it is in the way, or it is not. A
  /// car that stands itself also lets go who comes anyway, or of no worse rank
  /// has just set off.
  ///
  /// Who goes first leaves later than it would at its speed, if it has to wait
  /// for a third one by rank.
  ///
  /// Who goes first and is slow may come to rest among crossings that belong
  /// together: a car that is not among them yet waits before all of them.
  ///
  /// @param keep_free  From `look_ahead`.
  /// @param found      In the order of `from_m`.
  /// @param yields     Where zones begin whose other side goes first by rank.
  void judge(const crossing_viewer& me, std::span<other_body> others,
             std::span<const way_stretch> keep_free,
             std::vector<crossing_user>& found, std::vector<double>& yields);

  /// @returns how long a car that stands there is patient, s: longer where
  /// others go first, and each for another time, so that not all set off at
  /// once.
  /// @param front_m  Of its bumper, after `look_ahead`.
  double patience_s(const std::optional<station_id>& who, double front_m) const;

private:
  struct own_zone {
    world::zone on;
    world::path_point middle;
  };
  struct foreseen {
    std::size_t who;
    conflict_visit when;
  };
  double leaves_s(const foreseen& x) const;
  void find_zones(double from_m, double to_m);
  void foresee(std::span<const other_body> others);
  static double line_before(const crossing_viewer& me, const own_zone& own,
                            std::span<const way_stretch> keep_free);
  void join_zones(double rear_m, double front_m,
                  std::vector<way_stretch>& keep_free) const;
  bool gives_way(const crossing_viewer& me, const track& x,
                 const conflict_visit& when, const own_zone& own) const;
  bool would_turn_across(const conflict_visit& when, const own_zone& own) const;
  bool has_to_give_way(const crossing_viewer& me, const track& x,
                       const conflict_visit& when, const own_zone& own) const;
  bool drives_along(const track& x, const world::zone& z) const;
  bool stays_off(const track& x, const world::zone& z) const;
  double gap_m(const track& x, const world::zone& z) const;

  known_way_ptr way_;
  double corridor_m_, foresight_s_;
  std::vector<own_zone> zones_;
  std::vector<conflict_visit> arrivals_; // of one of the others
  std::vector<foreseen> foreseen_;
};

} // namespace sofof::planners
