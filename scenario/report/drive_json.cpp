// Packs a results folder.
#include "scenario/report/drive_json.hpp"

#include "scenario/report/packed.hpp"
#include "scenario/report/recorded_run.hpp"
#include "world/path.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::report {

namespace {

using nlohmann::json;

constexpr int metre_places = 3;   // as in tracks.csv
constexpr int second_places = 3;  // vehicles move in steps of 10 ms
constexpr int heading_places = 4; // 0.01 degrees
constexpr int street_places = 2;

/// What befell an offloading or a vehicle: shown on the map when it happens.
constexpr std::array<std::string_view, 5> alarming{
    "violation", "collision", "peer_lost", "provider_lost", "requester_lost"};
/// What else is worth a line.
constexpr std::array<std::string_view, 5> notable{
    "refused", "clock_in_doubt", "clock_known", "provider_connected",
    "arrived"};

bool is_one_of(std::span<const std::string_view> names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

json corners_json(std::span<const point> corners) {
  auto all = json::array();
  for (const auto& p : corners)
    all.push_back({p.x_m, p.y_m});
  return all;
}

std::array<point, 4> corners_of(const oriented_box& box) {
  const point along{std::cos(box.heading_rad), std::sin(box.heading_rad)};
  const auto half_length = box.length_m / 2 * along;
  const auto half_width = box.width_m / 2 * point{-along.y_m, along.x_m};
  return {box.centre + half_length + half_width,
          box.centre - half_length + half_width,
          box.centre - half_length - half_width,
          box.centre + half_length - half_width};
}

/// Points of a lane's smooth line, closer together where it bends.
std::vector<point> line_of(const lane& of) {
  constexpr double bend_rad = 0.05; // between two points
  constexpr double most_pieces = 32;
  const path smooth{of.centre};
  const auto knots = smooth.knots_m();
  std::vector<point> points{smooth.at(knots.front()).at};
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const auto from_m = knots[i - 1];
    const auto length_m = knots[i] - from_m;
    const auto turn_rad = std::abs(smooth.at(knots[i]).heading_rad
                                   - smooth.at(from_m).heading_rad);
    const auto pieces =
        std::clamp(std::ceil(turn_rad / bend_rad), 1.0, most_pieces);
    for (double k = 1; k <= pieces; ++k)
      points.push_back(smooth.at(from_m + length_m * k / pieces).at);
  }
  return points;
}

json lanes_json(const road_map& map) {
  std::vector<double> counts, half_widths_m, x_m, y_m;
  for (const auto& one : map.lanes()) {
    const auto points = line_of(one);
    counts.push_back(static_cast<double>(points.size()));
    half_widths_m.push_back(one.half_width_m);
    for (const auto& p : points) {
      x_m.push_back(p.x_m);
      y_m.push_back(p.y_m);
    }
  }
  return {{"counts", packed(counts, 0)},
          {"half_widths", packed(half_widths_m, street_places)},
          {"x", packed(x_m, street_places)},
          {"y", packed(y_m, street_places)}};
}

json houses_json(const scenario& what) {
  auto all = json::array();
  for (const auto& house : what.world->map.buildings())
    all.push_back(corners_json(house.corners));
  return all;
}

json obstacles_json(const scenario& what) {
  auto all = json::array();
  for (const auto& one : what.obstacles)
    all.push_back(corners_json(corners_of(one.box())));
  return all;
}

json providers_json(const scenario& what) {
  auto all = json::array();
  for (const auto& one : what.providers) {
    auto sensors = json::array();
    for (const auto& sensor : one.sensors)
      sensors.push_back({sensor.position_m.x_m, sensor.position_m.y_m});
    all.push_back({{"name", one.name},
                   {"at", {one.position_m.x_m, one.position_m.y_m}},
                   {"area", corners_json(one.area().corners())},
                   {"sensors", std::move(sensors)}});
  }
  return all;
}

json car_json() {
  const vehicle_params car;
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
                   {"t", packed(one.t_s, second_places)},
                   {"x", packed(one.x_m, metre_places)},
                   {"y", packed(one.y_m, metre_places)},
                   {"heading", packed(one.heading_rad, heading_places)},
                   {"speed", packed(one.speed_mps, metre_places)},
                   {"remote", packed(one.remote, 0)}});
  return all;
}

/// A time in which a service of a vehicle ran at a provider.
struct offloading {
  offloading_name of;
  double from_s = 0;
  double until_s = 0;
};

/// @param end_s  Ends what nobody has ended.
std::vector<offloading> switched(std::span<const event_line> events,
                                 double end_s) {
  std::vector<offloading> all;
  std::map<std::pair<std::uint64_t, std::string>, std::size_t> open;
  for (const auto& event : events) {
    if (event.what != "switch")
      continue;
    const std::pair key{event.of.station, event.of.service};
    if (const auto found = open.find(key); found != open.end()) {
      all[found->second].until_s = event.t_s;
      open.erase(found);
    }
    if (event.detail == "remote") {
      open[key] = all.size();
      all.push_back({event.of, event.t_s, end_s});
    }
  }
  return all;
}

std::vector<offloading> served(std::span<const episode_line> episodes) {
  std::vector<offloading> all;
  for (const auto& one : episodes)
    if (!one.by_requester)
      all.push_back({one.of, one.accepted_s, one.ended_s});
  return all;
}

json offloadings_json(std::span<const offloading> offloadings) {
  auto all = json::array();
  for (const auto& one : offloadings)
    all.push_back({one.of.station, one.of.service, one.of.provider, one.from_s,
                   one.until_s});
  return all;
}

json events_json(std::span<const event_line> events) {
  auto all = json::array();
  for (const auto& one : events) {
    const auto alarm = is_one_of(alarming, one.what);
    if (alarm || is_one_of(notable, one.what))
      all.push_back({one.t_s, one.what, one.of.station, one.of.provider,
                     one.of.service, one.detail, alarm});
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

  auto offloadings = switched(events, end_s);
  if (offloadings.empty())
    offloadings = served(run.episodes);
  return {{"name", run.label},
          {"until", end_s},
          {"has_tracks", tracks.has_value()},
          {"lanes", lanes_json(run.what.world->map)},
          {"houses", houses_json(run.what)},
          {"obstacles", obstacles_json(run.what)},
          {"providers", providers_json(run.what)},
          {"car", car_json()},
          {"services", services_of({&run, 1})},
          {"vehicles", vehicles_json(lines)},
          {"offloadings", offloadings_json(offloadings)},
          {"events", events_json(events)}};
}

} // namespace sofof::report
