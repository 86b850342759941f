// The soonest drive along a way within windows of time, stops included.
#pragma once

#include "planners/crossing/way_motion.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace sofof::planners {

/// Finds drives over a grid of places and speeds: for each, the times at which
/// a car can be there so. No heap once it has solved a problem of the size.
class window_drive {
public:
  static constexpr double step_m = 2; ///< Between places.

  struct task {
    double s_m = 0;       ///< Middle of the car on its route, now.
    double speed_mps = 0; ///< >= 0.
    double accel_mps2 = 0;
    double line_m = 0;    ///< Before it, it comes as soon as it may and waits
                          ///< there; behind it, it goes as fast as it may.
    /// At `s_m`, and every `step_m` from there on; both alike in number, >= 2.
    std::span<const double> earliest_s, latest_s;
  };

  explicit window_drive(const free_drive_limits& limits);

  /// @returns whether there is a drive; the soonest at the last of the places.
  bool find(const route_profile& way, const task& what, way_motion& out);

private:
  struct state { // at a place with a speed
    float from_s, to_s;
  };
  enum has_stood : unsigned char { no, yes };
  state& at(has_stood how, std::size_t place, std::size_t level) {
    return states_[how][place * speeds_.size() + level];
  }
  void begin(const task& what, bool smoothly);
  void bound(const route_profile& way, const task& what);
  void reach(const task& what);
  bool read_back(const task& what, way_motion& out);

  std::size_t up_, down_; // levels in a step
  std::vector<double> speeds_;
  std::vector<std::size_t> top_; // highest level at each place
  std::array<std::vector<state>, 2> states_; // by whether it has stood
  double begin_w_ = 0, begin_m_ = 0, begin_mps_ = 0, begin_s_ = 0;
  std::size_t first_ = 1;
  std::vector<double> prefix_;
};

} // namespace sofof::planners
