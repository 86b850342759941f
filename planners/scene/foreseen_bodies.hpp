// Where the bodies that a vehicle sees will be on its own way, and whether it
// would touch them.
#pragma once

#include "world/roads/route.hpp"
#include "world/sensing/perception.hpp"
#include "world/vehicle/vehicle.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace sofof::planners {

/// A vehicle's place on its route at one moment.
struct place_in_time {
  double t_s = 0;    ///< From now on.
  double s_m = 0;    ///< Rear axle, arc length on the route, laps included.
  double d_m = 0;    ///< Its offset, left positive.
  double turned = 0; ///< Sine of the heading to the way: what is before the
                     ///< axle is so much farther left, m per m.
  double speed_mps = 0;
};

/// The bodies near a vehicle's way, each as a box along that way:
/// * who drives along the way, or against it, keeps its offset: it follows the
///   street, and not a straight line; if it brakes, it goes on braking;
/// * who crosses the way counts while it is on it, or when it cannot stop
///   before it any more, and goes straight on;
/// * who is behind the vehicle keeps its distance by itself; who is more than
///   20 m behind it, as the vehicle points, is left out, wherever the way
///   leads.
class foreseen_bodies {
public:
  /// Takes what a sensor saw just now.
  /// @param s_m  The vehicle's rear axle on the route.
  /// @param car  Its body.
  void look(const world::route& way, double s_m,
            std::span<const world::perceived_object> seen,
            const world::vehicle_params& car);

  /// @returns whether any could be touched within so long by a vehicle that
  /// goes no farther than that; cheap.
  /// @param ahead_m   Of the place given to `look`.
  /// @param beside_m  The own middle to the left or right of the way.
  bool any_in_reach(double ahead_m, double beside_m, double until_s) const;

  /// When a vehicle touches which kind of body.
  struct touch {
    double t_s;
    bool crosses; ///< The body does not drive along the way.
  };

  /// @returns when a vehicle that moves touches one of them; nullopt: never.
  /// Whoever rests touches nobody, and who nearly does touches nobody that
  /// crosses. Of who crosses only the core is touched: it may be turning. Who
  /// creeps touches who is ahead when it comes nearer than `kept_gap_m`.
  std::optional<touch> first_touch(std::span<const place_in_time> motion,
                                   const world::vehicle_params& car,
                                   double kept_gap_m = 0) const;

  /// @returns whether one of them is, or soon comes, so near before the
  /// vehicle that it has a reason to brake.
  /// @param within_m  How far before its front bumper.
  bool any_ahead(double within_m) const;

  /// The same, of bodies that stand or drive up to `beside_m` beside the lane,
  /// too: where drivers judge crossings they may be waited for.
  bool any_near(double within_m, double beside_m) const;

private:
  /// Bodies farther away than this are no matter of the next seconds.
  static constexpr double farthest_m = 90;
  /// Beside the way, the same.
  static constexpr double farthest_beside_m = 60;
  /// cos 37°: who drives at a smaller angle to the way drives along it.
  static constexpr double along_cosine = 0.8;
  /// A sighting is off by 0.1 m (standard deviation): that much of a body's
  /// edge is not certain.
  static constexpr double uncertain_m = 0.15;
  /// Who can stop before the way by this braking is expected to.
  static constexpr double expected_decel_mps2 = 3;
  /// Less is the sensor's noise, or coasting.
  static constexpr double least_braking_mps2 = 1;
  /// A body so near beside the own body is a reason to brake.
  static constexpr double near_beside_m = 1.0;
  /// Who comes onto the way this soon is, too.
  static constexpr double soon_s = 4;
  /// Who is as slow as this is hit by who crosses, and does not hit it.
  static constexpr double stands_mps = 0.3;
  /// Who is as slow as this hits nobody.
  static constexpr double rests_mps = 0.01;
  /// Who is slower than this keeps a gap to a body that stands or drives ahead
  /// of it, but not to one that it only grazes by so much: it may be passing
  /// it.
  static constexpr double creeps_mps = 2.0;
  static constexpr double grazes_m = 0.3;

  struct box {
    double s_m, d_m;                    // of its middle
    double half_length_m, half_width_m; // along and across the way
    double along_mps, across_mps;
    double brakes_mps2; // along the way, >= 0
    double core_m;      // for touching, no more than this of both halves
    bool counts;        // for touching
    bool crosses;
  };
  static double along_m(const box& x, double t_s);
  bool touches(const box& x, const place_in_time& p,
               const world::vehicle_params& car, double kept_gap_m) const;

  std::vector<box> boxes_; // the room is used again
  double front_m_ = 0;     // of the vehicle, arc length
  double rear_m_ = 0;      // likewise
  double half_corridor_m_ = 0;
};

} // namespace sofof::planners
