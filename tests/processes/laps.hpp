// When a vehicle has come round, from its track.
#pragma once

#include "tests/processes/results_reader.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace sofof::test {

struct lap {
  double begin_s = 0;
  double end_s = 0;
};

/// @returns the complete laps of a vehicle: each time that it comes back to
/// where it started.
inline std::vector<lap> laps_of(const std::vector<row>& tracks,
                                const std::string& station) {
  constexpr double far_m = 2000; // the round trip has 2.8 km
  constexpr double there_m = 3;  // 14 m/s are 1.4 m from line to line
  std::vector<lap> laps;
  std::optional<row> start;
  double begin_s = 0, begin_m = 0;
  for (const auto& r : tracks) {
    if (r.at("station") != station)
      continue;
    if (!start) {
      start = r;
      begin_m = number(r, "s_m");
      continue;
    }
    const auto from_start_m =
        std::hypot(number(r, "x_m") - number(*start, "x_m"),
                   number(r, "y_m") - number(*start, "y_m"));
    if (number(r, "s_m") - begin_m < far_m || from_start_m > there_m)
      continue;
    laps.push_back({begin_s, number(r, "t_s")});
    begin_s = number(r, "t_s");
    begin_m = number(r, "s_m");
  }
  return laps;
}

} // namespace sofof::test
