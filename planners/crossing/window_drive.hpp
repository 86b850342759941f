// The soonest drive along a way within windows of time, stops included.
#pragma once

#include "planners/crossing/way_motion.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace sofof::planners {

/// Finds drives over a grid of places and of v²/2: for each, between which
/// times a car can be there so. A car that has stood can be anywhere at any
/// later time; one that has not is thought to reach all times between the
/// first and the last, which holds but for fractions of a second. No heap once
/// it has solved a problem of the size.
class window_drive {
public:
  static constexpr double step_m = 2; ///< Between places.

  struct task {
    double s_m = 0;        ///< Middle of the car on its route, now.
    double speed_mps = 0;  ///< >= 0.
    double accel_mps2 = 0; ///< Fades out first, as far as there is time.
    /// Before it, a car comes as late and fast as it may; behind it, it drives
    /// as fast as it may, so that the crossing is free early.
    double line_m = 0;
    /// At `s_m`, and every `step_m` from there on; both alike in number, >= 2.
    std::span<const double> earliest_s, latest_s;
  };

  explicit window_drive(const free_drive_limits& limits);

  /// @param out  From where the car is to the last of the places.
  /// @returns whether there is a drive; it is the soonest at the last place.
  bool find(const route_profile& way, const task& what, way_motion& out);

private:
  /// The times at which a car can be at a place with a speed; none if it
  /// begins after it ends.
  struct reached {
    float from_s = 1, to_s = 0;
    bool is_empty() const { return from_s > to_s; }
  };
  enum class past : unsigned char { rolled, stood };
  static constexpr std::array pasts{past::rolled, past::stood};

  /// One place on the way back.
  struct moment {
    past how;
    std::size_t level;
    double t_s;
  };

  reached& at(past how, std::size_t place, std::size_t level) {
    return reached_[static_cast<std::size_t>(how)]
                   [place * speeds_.size() + level];
  }
  void begin(const task& what, bool smoothly);
  void bound(const route_profile& way, const task& what);
  void reach(const task& what);
  void reach_first(const task& what);
  void reach_next(const task& what, std::size_t place, std::size_t level);
  void reach_at(const task& what, past how, std::size_t place,
                std::size_t level, double from_s, double to_s);
  double takes_s(std::size_t from_level, std::size_t to_level) const;
  bool read_back(const task& what, way_motion& out);
  bool find_end(std::size_t place, moment& out);
  bool step_back(std::size_t place, bool comes_late, const moment& here,
                 moment& before);
  void write_first(double goes_s, double left_s);

  std::size_t up_, down_; // levels in a step
  std::vector<double> speeds_;
  std::vector<std::size_t> top_; // highest level at each place
  std::array<std::vector<reached>, pasts.size()> reached_;
  // Where the grid begins: its acceleration has faded out.
  double begin_m_ = 0, begin_mps_ = 0, begin_s_ = 0;
  std::size_t first_ = 1;       // place behind it
  std::vector<double> fade_s_;  // times at each half metre until then
  std::vector<double> times_s_; // of the drive, each half metre
};

} // namespace sofof::planners
