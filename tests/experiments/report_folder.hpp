// A results folder of a made-up run, and ways to spoil it.
#pragma once

#include "base/input_error.hpp"
#include "recording/results.hpp"
#include "tests/support/made_up_run.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <unistd.h>

namespace sofof::made_up {

/// What the made-up vehicles drove on.
inline constexpr std::string_view config = R"(name = "made_up"
seed = 7

[street_grid]
columns = 2
rows = 2

[[fleet]]
count = 2
routes = ["block *"]

[[provider]]
name = "mec"
position_m = [75.0, 75.0]

[[service]]
name = "trajectory_planning"

[[service]]
name = "cabin_climate"
)";

inline messages::track_record track(station_id station, duration when,
                                    point place, bool remote) {
  messages::track_record x;
  x.at = at(when);
  x.ego.own.station = station;
  x.ego.own.position = place;
  x.remote = remote;
  return x;
}

/// A folder with the results of `play`, gone with its test.
class played_folder {
public:
  explicit played_folder(const std::string& name = "made_up-7") {
    static std::atomic<int> count = 0;
    base_ = std::filesystem::temp_directory_path()
            / ("sofof_report_" + std::to_string(getpid()) + "_"
               + std::to_string(count++));
    folder_ = base_ / name;
    std::filesystem::create_directories(folder_);
    auto info = run();
    info.config_toml = config;
    recording::results to{folder_, info};
    play(to);
    for (int i = 0; i < 3; ++i)
      to.on_record(track(101, i * 100ms, {1.5 * i, -2}, i > 0));
    to.on_record(messages::event_record{at(65s),
                                        messages::event_type::violation, 101,
                                        provider, planning, 2, "qos_gap"});
    to.finish(at(100s), 0.5, false);
  }
  ~played_folder() { std::filesystem::remove_all(base_); }
  played_folder(const played_folder&) = delete;
  played_folder& operator=(const played_folder&) = delete;

  const std::filesystem::path& path() const { return folder_; }

  std::string read(std::string_view file) const {
    std::ifstream in{folder_ / file, std::ios::binary};
    REQUIRE(in.good());
    return {std::istreambuf_iterator<char>{in}, {}};
  }

  void write(std::string_view file, std::string_view text) const {
    std::ofstream{folder_ / file, std::ios::binary} << text;
  }

  /// Replaces the first `from` in a file.
  void spoil(std::string_view file, std::string_view from,
             std::string_view to) const {
    auto text = read(file);
    const auto place = text.find(from);
    REQUIRE(place != text.npos);
    write(file, text.replace(place, from.size(), to));
  }

  /// As if all had ended as planned.
  void ends_no_episode_early() const {
    spoil("summary.json", "\"fallbacks\": 1,", "\"fallbacks\": 0,");
  }

private:
  std::filesystem::path base_;
  std::filesystem::path folder_;
};

} // namespace sofof::made_up
