// What a results folder says of where and when cars were, row by row.
#pragma once

#include "base/geometry.hpp"
#include "base/text/csv_reader.hpp"
#include "messages/v2x/geo_frame.hpp"
#include "scenario/scenario.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>

namespace sofof::experiments::convert {

/// A run, and where and when on Earth it was.
struct recorded_drive {
  std::filesystem::path folder;
  scenario::scenario_definition what;
  messages::geo_frame frame;
  std::int64_t start_unix_ns = 0; ///< When its clock stood at 0.

  /// @returns ns since 1970.
  std::uint64_t unix_ns(double t_s) const;
};

/// @throws input_error when it is no results folder, or broken.
recorded_drive open_drive(const std::filesystem::path& folder);

/// Where a car was.
struct track_row {
  double t_s = 0;
  std::uint64_t station = 0;
  point at; ///< Of the rear axle, m.
  double heading_rad = 0;
  double speed_mps = 0, accel_mps2 = 0;
  double s_m = 0;       ///< Along its route.
  double lateral_m = 0; ///< Off the lane's centre.
  double plan_age_ms = 0;
  bool remote = false;
};

/// Reads tracks.csv, in order of time, a row in memory at once.
class track_file {
public:
  /// @throws input_error when the run was told not to write it.
  explicit track_file(const std::filesystem::path& folder);

  /// @returns the next row; nullopt after the last. @throws input_error.
  std::optional<track_row> next();

private:
  csv_reader rows_;
};

} // namespace sofof::experiments::convert
