// Everything on the road that somebody sees, as tracks: what many observers
// tell, brought to one time and put together.
#pragma once

#include "planners/scene/track.hpp"
#include "world/sensing/perception.hpp"
#include "world/sensing/sensors.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace sofof::planners {

/// How well observers see: standard deviations.
struct sighting_noise {
  double position_m = 0.1; ///< Of each coordinate.
  double speed_mps = 0.1;
  double heading_rad = 0.01;
};

/// @returns that of a sensor, at least of a very good one: what is told has
/// been rounded.
sighting_noise noise_of(const world::sensor_params& sensor);

/// When observers tell again of a body that they still see.
struct sighting_rhythm {
  double moved_m = 0;   ///< When it has moved so far, ...
  duration at_latest{}; ///< ... at the latest after so long; 0: at every look.

  /// @returns how long nothing is told of a body at that speed, >= 0.
  duration silence(double speed_mps) const;
};

/// Tracks of all bodies that observers see, and of vehicles that tell their
/// own motion. Observers tell their clocks' true times, in any order.
///
/// * One time: all tracks are kept at the time of the newest sighting. An
///   older one (another observer, a slow link) is predicted forward to it,
///   uncertainty included: a sighting has a velocity, so it is an estimate
///   of its own. That needs no history, as going back would; it takes the
///   manoeuvres since for independent of the track's, a small matter within
///   the half second after which sightings are dropped.
/// * Same body? A sighting and a track match within a gate, the likeliest
///   pairs first; each track takes one sighting of each `update` at most.
///   Whatever its speed is said to be, a sighting in the very place of a
///   track is of its body: two cannot be in one place.
/// * Birth at the first sighting, without confirmation: whoever brakes late
///   for a body brakes hard.
/// * Death after a second without sightings; later where sightings are told so
///   rarely that one lost message and the slowest next one take longer, and
///   after four seconds of what is behind another body, as the only observer
///   sees it: who waits for a car must not forget it when the next one stops
///   in between. The uncertainty grows meanwhile.
class object_tracker {
public:
  explicit object_tracker(sighting_noise noise = {},
                          sighting_rhythm rhythm = {});

  /// Tells what one observer sees.
  /// @param at    When it saw this.
  /// @param seen  Each body once, in any order; those that no body on a road
  ///              can be (not finite, 0 m or 61 m long, 101 m/s, 1e7 m away)
  ///              are left out, and so are all after the first 256. May be
  ///              empty: time passes.
  /// @param eye   Where the observer is, if there is only this one.
  void update(time_point at, std::span<const world::perceived_object> seen,
              std::optional<point> eye = std::nullopt);

  /// Tells what a connected vehicle says of itself (a CAM); from now on its
  /// track bears its name.
  void on_report(time_point at, station_id who,
                 const world::perceived_object& self);

  /// @returns all tracks in order of `id`, at the time of the newest sighting;
  /// for any later time see `predict`. Valid until the next update.
  std::span<const track> tracks() const { return tracks_; }

private:
  struct observation {
    world::perceived_object object;
    motion_estimate motion;
    bool is_known; // to be of a body with a track
    bool is_taken;
  };
  struct pair {
    bool in_gate;
    double cost;
    std::uint32_t track, observation;
  };

  bool pass_time(time_point at);
  duration lifetime(const track& x) const;
  bool is_hidden(const track& x) const;
  observation make_sighting(time_point at,
                            const world::perceived_object& o) const;
  void match(std::uint32_t t, std::uint32_t s);
  void pair_up(time_point at);
  void settle(track& x, const motion_estimate& seen, double dt_s,
              bool stood) const;
  void correct(track& x, time_point at, const observation& s, bool fits);
  void turn(track& x, double heading_rad, double dt_s,
            double share_of_new) const;
  void give_birth(time_point at, const observation& s);

  sighting_noise noise_;
  sighting_rhythm rhythm_;
  time_point newest_{-longest_time};
  std::optional<point> eye_;
  std::uint32_t last_id_ = 0;
  std::vector<track> tracks_;
  std::vector<observation> sightings_;
  std::vector<pair> pairs_;
  std::vector<char> is_taken_; // of each track
  std::vector<std::uint32_t> forgotten_;
};

} // namespace sofof::planners
