// How far a run is, for somebody who waits for it.
#pragma once

#include <cstddef>
#include <ostream>
#include <string>

namespace sofof::recording {

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

  /// The same for a line of the caller's own; `line()` is asked for it when it
  /// is time.
  template <class Line>
  void show(const Line& line, double wall_s) {
    if (is_due(wall_s))
      draw(line());
  }

  /// Wipes the line off the terminal; what comes next has room.
  void clear();

private:
  /// @returns whether it is time for a line, which must be drawn then.
  bool is_due(double wall_s);
  void draw(const std::string& line);

  std::ostream& out_;
  output how_;
  double last_wall_s_ = 0;
  bool drawn_ = false;
};

/// @returns "8 s", "3 min 5 s", or "2 h 7 min".
std::string for_people(double seconds);

} // namespace sofof::recording
