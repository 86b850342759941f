// What a results folder says of where and when cars were, row by row.
#pragma once

#include "base/geometry.hpp"
#include "base/text/csv_reader.hpp"
#include "messages/v2x/geo_frame.hpp"
#include "scenario/scenario.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

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

/// @returns how the files of a results folder may end.
csv_reader::ending ending_of(const std::filesystem::path& folder);

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

/// Where a car was going to drive.
struct planned_path {
  double t_s = 0; ///< That it followed this then.
  std::uint64_t station = 0;
  std::vector<point> points; ///< Of the rear axle, m, in order of time.
};

/// Reads plans.csv, in order of time, a plan in memory at once; nothing where
/// the run was not told to write it.
class plan_file {
public:
  explicit plan_file(const std::filesystem::path& folder);

  /// @returns the next one; nullopt after the last. @throws input_error.
  std::optional<planned_path> next();

private:
  bool read_on();

  std::optional<csv_reader> rows_;
  planned_path ahead_; ///< The row that is read, of the next plan.
  bool is_over_ = false;
};

} // namespace sofof::experiments::convert
