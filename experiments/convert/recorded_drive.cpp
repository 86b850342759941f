// config.toml, summary.json and tracks.csv.
#include "experiments/convert/recorded_drive.hpp"

#include "base/input_error.hpp"
#include "experiments/report/recorded_run.hpp"
#include "messages/etsi/its_time.hpp"
#include "scenario/load.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <utility>

namespace sofof::experiments::convert {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view columns[]{"t_s",         "station",     "x_m",
                                     "y_m",         "heading_rad", "speed_mps",
                                     "accel_mps2",  "s_m",         "lateral_m",
                                     "plan_age_ms", "source"};

const fs::path& check_tracks(const fs::path& file) {
  if (!fs::exists(file))
    throw input_error{fmt::format("{} is not there: the run was told not to "
                                  "write tracks; run its config.toml again "
                                  "with --set record.tracks=true.",
                                  file.string())};
  return file;
}

} // namespace

csv_reader::ending ending_of(const fs::path& folder) {
  return fs::exists(folder / "summary.json") ? csv_reader::ending::whole
                                             : csv_reader::ending::killed;
}

std::uint64_t recorded_drive::unix_ns(double t_s) const {
  constexpr double ns_per_s = 1e9;
  return static_cast<std::uint64_t>(start_unix_ns
                                    + std::llround(ns_per_s * t_s));
}

recorded_drive open_drive(const fs::path& folder) {
  recorded_drive drive;
  drive.folder = folder;
  drive.what = scenario::parse_scenario(report::config_of(folder),
                                        folder / "config.toml");
  drive.frame = messages::geo_frame{drive.what.world->map.origin()};
  auto start_unix_ms =
      static_cast<double>(messages::etsi::virtual_epoch_unix_ms);
  if (const auto summary = report::read_summary(folder))
    if (const auto x = summary->figures.find("start_unix_ms");
        x != summary->figures.end())
      start_unix_ms = x->second;
  constexpr double ns_per_ms = 1e6;
  drive.start_unix_ns = std::llround(ns_per_ms * start_unix_ms);
  return drive;
}

track_file::track_file(const fs::path& folder)
    : rows_{check_tracks(folder / "tracks.csv"), columns, ending_of(folder)} {}

std::optional<track_row> track_file::next() {
  if (!rows_.next())
    return std::nullopt;
  enum { t, station, x, y, heading, speed, accel, s, lateral, age, source };
  if (rows_.text(source) != "remote" && rows_.text(source) != "local")
    rows_.refuse(source, "is neither \"local\" nor \"remote\"");
  return track_row{.t_s = rows_.number(t),
                   .station = rows_.whole(station),
                   .at = {rows_.number(x), rows_.number(y)},
                   .heading_rad = rows_.number(heading),
                   .speed_mps = rows_.number(speed),
                   .accel_mps2 = rows_.number(accel),
                   .s_m = rows_.number(s),
                   .lateral_m = rows_.number(lateral),
                   .plan_age_ms = rows_.number(age),
                   .remote = rows_.text(source) == "remote"};
}

plan_file::plan_file(const fs::path& folder) {
  static constexpr std::string_view names[]{"t_s", "station", "x_m", "y_m"};
  if (const auto file = folder / "plans.csv"; fs::exists(file))
    rows_.emplace(file, names, ending_of(folder));
  is_over_ = !rows_ || !read_on();
}

/// Reads the next row. @returns false after the last one.
bool plan_file::read_on() {
  if (!rows_->next())
    return false;
  enum { t, station, x, y };
  ahead_ = {.t_s = rows_->number(t),
            .station = rows_->whole(station),
            .points = {{rows_->number(x), rows_->number(y)}}};
  return true;
}

std::optional<planned_path> plan_file::next() {
  if (is_over_)
    return std::nullopt;
  auto path = std::move(ahead_);
  for (;;) {
    is_over_ = !read_on();
    if (is_over_ || ahead_.t_s != path.t_s || ahead_.station != path.station)
      return path;
    path.points.push_back(ahead_.points.front());
  }
}

} // namespace sofof::experiments::convert
