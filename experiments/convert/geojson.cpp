// RFC 7946.
#include "experiments/convert/geojson.hpp"

#include "base/text/json.hpp"
#include "experiments/convert/formats.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace sofof::experiments::convert {

namespace {

constexpr std::size_t longest_line = 256; // points

std::string place_of(const messages::geo_frame& frame, point at) {
  constexpr double per_degree = 1e-7;
  const auto on_earth = frame.to_wgs84(at);
  return fmt::format("[{:.7f},{:.7f}]", per_degree * on_earth.longitude,
                     per_degree * on_earth.latitude);
}

/// @param properties  Inside the braces of an object.
std::string feature(std::string_view kind, const std::string& coordinates,
                    const std::string& properties) {
  return fmt::format(R"({{"type":"Feature","geometry":{{"type":"{}",)"
                     R"("coordinates":{}}},"properties":{{{}}}}})",
                     kind, coordinates, properties);
}

std::string named(std::string_view kind, std::string_view name) {
  auto text = fmt::format(R"("kind":"{}","name":)", kind);
  append_quoted(text, name);
  return text;
}

/// The corner that a ring begins with ends it, too.
std::string ring_of(const messages::geo_frame& frame,
                    std::vector<point> corners) {
  if (!corners.empty())
    corners.push_back(corners.front());
  return "[" + coordinates_of(frame, corners) + "]";
}

void append_feature(std::string& to, const std::string& one) {
  to += (to.empty() ? "" : ",\n") + one;
}

/// What a car has driven since the side that plans for it changed last.
struct stretch {
  std::vector<point> points;
  double from_s = 0, until_s = 0;
  bool remote = false;
};

std::string feature_of(const messages::geo_frame& frame, std::uint64_t station,
                       const stretch& x) {
  return feature("LineString", coordinates_of(frame, x.points),
                 fmt::format(R"("kind":"way","station":{},"from_s":{:.3f},)"
                             R"("until_s":{:.3f},"offloaded":{})",
                             station, x.from_s, x.until_s, x.remote));
}

} // namespace

std::string coordinates_of(const messages::geo_frame& frame,
                           std::span<const point> points) {
  std::string text;
  for (const auto& at : points)
    text += (text.empty() ? "" : ",") + place_of(frame, at);
  return "[" + text + "]";
}

std::string scenery_features(const recorded_drive& drive) {
  const auto& map = drive.what.world->map;
  std::string all;
  for (const auto& lane : map.lanes())
    append_feature(all, feature("LineString",
                                coordinates_of(drive.frame, lane.centre),
                                named("lane", lane.name)));
  for (const auto& house : map.buildings())
    append_feature(all, feature("Polygon",
                                ring_of(drive.frame, {house.corners.begin(),
                                                      house.corners.end()}),
                                R"("kind":"house")"));
  for (const auto& one : drive.what.providers) {
    append_feature(all, feature("Polygon",
                                ring_of(drive.frame, one.area().corners()),
                                named("area", one.name)));
    append_feature(all, feature("Point", place_of(drive.frame, one.position_m),
                                named("provider", one.name)));
  }
  return all;
}

std::string feature_collection(const std::string& features) {
  return "{\"type\":\"FeatureCollection\",\"features\":[" + features + "]}";
}

void write_geojson(const recorded_drive& drive, const sink& put) {
  put("{\"type\":\"FeatureCollection\",\"features\":[\n");
  const auto scenery = scenery_features(drive);
  put(scenery);
  bool is_first = scenery.empty();
  const auto tell = [&](std::uint64_t station, const stretch& x) {
    if (x.points.size() < 2)
      return;
    put(std::exchange(is_first, false) ? "" : ",\n");
    put(feature_of(drive.frame, station, x));
  };
  std::map<std::uint64_t, stretch> cars;
  track_file rows{drive.folder};
  while (const auto row = rows.next()) {
    auto& x = cars[row->station];
    const auto is_new = x.points.empty();
    if (!is_new) {
      x.points.push_back(row->at);
      x.until_s = row->t_s;
    }
    if (is_new || x.remote != row->remote || x.points.size() >= longest_line) {
      tell(row->station, x);
      x = {{row->at}, row->t_s, row->t_s, row->remote};
    }
  }
  for (const auto& [station, x] : cars)
    tell(station, x);
  put("\n]}\n");
}

} // namespace sofof::experiments::convert
