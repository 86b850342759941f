// Packs a results folder.
#include "experiments/report/drive_json.hpp"

#include "experiments/report/delta_encoding.hpp"
#include "experiments/report/event_group.hpp"
#include "experiments/report/offloading_spans.hpp"
#include "experiments/report/recorded_run.hpp"
#include "experiments/report/scenery_json.hpp"
#include "messages/protocol/event_type.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::experiments::report {

namespace {

using nlohmann::json;

constexpr int metre_places = 3;   // as in tracks.csv
constexpr int second_places = 3;  // vehicles move in steps of 10 ms
constexpr int heading_places = 4; // 0.01 degrees

json car_json() {
  const world::vehicle_params car;
  return {{"front", car.front_m}, {"rear", car.rear_m}, {"width", car.width_m}};
}

/// One vehicle's lines of tracks.csv, column by column.
struct track {
  std::vector<double> t_s, x_m, y_m, heading_rad, speed_mps, remote;

  void add(const track_line& line) {
    t_s.push_back(line.t_s);
    x_m.push_back(line.x_m);
    y_m.push_back(line.y_m);
    heading_rad.push_back(line.heading_rad);
    speed_mps.push_back(line.speed_mps);
    remote.push_back(line.remote ? 1 : 0);
  }
};

json vehicles_json(std::span<const track_line> lines) {
  std::map<std::uint64_t, track> tracks;
  for (const auto& line : lines)
    tracks[line.station].add(line);
  auto all = json::array();
  for (const auto& [station, one] : tracks)
    all.push_back({{"station", station},
                   {"t", delta_encoding(one.t_s, second_places)},
                   {"x", delta_encoding(one.x_m, metre_places)},
                   {"y", delta_encoding(one.y_m, metre_places)},
                   {"heading", delta_encoding(one.heading_rad, heading_places)},
                   {"speed", delta_encoding(one.speed_mps, metre_places)},
                   {"remote", delta_encoding(one.remote, 0)}});
  return all;
}

json offloadings_json(std::span<const offloading_span> offloadings) {
  auto all = json::array();
  for (const auto& one : offloadings)
    all.push_back({one.of.station, one.of.service, one.of.provider, one.from_s,
                   one.until_s});
  return all;
}

json events_json(std::span<const event_line> events) {
  auto all = json::array();
  for (const auto& one : events) {
    const auto group = group_of(one.what);
    if (!group.empty())
      all.push_back({one.t_s, one.what, one.of.station, one.of.provider,
                     one.of.service, one.detail, group});
  }
  return all;
}

} // namespace

json drive_json(const std::filesystem::path& folder) {
  const auto run = open_run(folder);
  const auto events = read_events(folder);
  const auto tracks = read_tracks(folder);
  const auto lines = tracks.value_or(std::vector<track_line>{});

  double end_s = run.figure("virtual_s").value_or(0);
  const auto reaches = [&end_s](double t_s) { end_s = std::max(end_s, t_s); };
  for (const auto& line : lines)
    reaches(line.t_s);
  for (const auto& event : events)
    reaches(event.t_s);
  for (const auto& episode : run.episodes)
    reaches(episode.ended_s);

  const auto offloadings = offloadings_of(run, events, end_s);
  json all{{"name", run.label},
           {"until", end_s},
           {"has_tracks", tracks.has_value()},
           {"car", car_json()},
           {"services", services_of({&run, 1})},
           {"vehicles", vehicles_json(lines)},
           {"offloadings", offloadings_json(offloadings)},
           {"events", events_json(events)}};
  if (const auto chain = scenario::chain_of(run.what); chain.size() > 1)
    all["chain"] = chain;
  all.update(scenery_json(run.what));
  return all;
}

} // namespace sofof::experiments::report
