// How far a run is, for somebody who waits for it.
#pragma once

#include <cstddef>
#include <ostream>
#include <string>

namespace sofof {

/// Shows one line that stays up to date, a plain line now and then, or
/// nothing. It reads no clock: the time on the wall is handed in.
class progress {
public:
  enum class output {
    terminal, ///< One line, redrawn at most 5 times a second.
    plain,    ///< A new line every 10 s.
    quiet,
  };

  progress(std::ostream& out, output how) : out_{out}, how_{how} {}

  /// To be called as often as one likes.
  /// @param virtual_s      On the run's clock, since its start.
  /// @param total_s        Its planned length, > 0.
  /// @param offloaded_now  Vehicles.
  /// @param wall_s         On the wall's clock, since the run's start.
  void update(double virtual_s, double total_s, std::size_t offloaded_now,
              double wall_s);

  /// Wipes the line off the terminal; what comes next has room.
  void clear();

private:
  std::ostream& out_;
  output how_;
  double last_wall_s_ = 0;
  bool drawn_ = false;
};

} // namespace sofof
