// Reads the lanes of a CommonRoad scenario.
#include "maps/commonroad.hpp"

#include <fmt/format.h>

#include "maps/bounds.hpp"
#include "maps/road_limits.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>

namespace sofof::maps {

namespace {

constexpr auto usual_limit_mps = 50 / 3.6;

/// Lanelets that meet to within this follow each other, m.
constexpr auto successor_joint_m = 2.0;

constexpr auto narrowest_lane_m = 1.0; // half of it

/// Signs of speed limits, of Germany, the USA and others.
constexpr std::array<std::string_view, 4> limit_signs{"274", "274.1", "R2-1",
                                                      "r301"};

/// Give way, and stop, of Germany and the USA.
constexpr std::array<std::string_view, 4> yield_signs{"205", "206", "R1-1",
                                                      "R1-2"};

/// What is counted and left out: elements and their names.
constexpr std::array<std::pair<const char*, const char*>, 5> others{
    {{"obstacle", "obstacles"},
     {"staticObstacle", "obstacles"},
     {"dynamicObstacle", "obstacles"},
     {"planningProblem", "planning problems"},
     {"trafficLight", "traffic lights"}}};

constexpr std::array<std::string_view, 6> closed_types{
    "sidewalk", "crosswalk", "bicycleLane", "busLane", "restricted", "border"};

class commonroad_reader {
public:
  explicit commonroad_reader(const xml_file& file)
      : file_{file}, limits_of_roads_{file} {}

  source_map read() {
    for (const auto sign : file_.root().children("trafficSign"))
      read_sign(sign);
    for (const auto lanelet : file_.root().children("lanelet"))
      read_lanelet(lanelet);
    move_to_middle();
    for (const auto lanelet : file_.root().children("lanelet"))
      link(lanelet);
    rank_lanes();
    for (const auto& [element, name] : others) {
      const auto all = file_.root().children(element);
      if (const auto count = std::distance(all.begin(), all.end()); count > 0)
        map_.left_out[name] += static_cast<std::size_t>(count);
    }
    return std::move(map_);
  }

private:
  void read_sign(pugi::xml_node sign) {
    for (const auto part : sign.children("trafficSignElement")) {
      const std::string_view id = part.child_value("trafficSignID");
      if (std::ranges::find(yield_signs, id) != yield_signs.end())
        yield_signs_.emplace(file_.text(sign, "id"));
      const auto value = part.child("additionalValue");
      if (value && std::ranges::find(limit_signs, id) != limit_signs.end())
        limits_.emplace(file_.text(sign, "id"),
                        file_.to_number(value.child_value(), value, 0.5, 100));
    }
  }

  std::vector<point> bound(pugi::xml_node lanelet, const char* side) {
    std::vector<point> points;
    for (const auto p : lanelet.child(side).children("point")) {
      const auto coordinate = [&](const char* name) {
        return file_.to_number(p.child_value(name), p);
      };
      points.push_back({coordinate("x"), coordinate("y")});
    }
    if (points.size() < 2)
      file_.refuse(lanelet, fmt::format("<{}> needs two points.", side));
    limits_of_roads_.count_line(lanelet, points);
    return points;
  }

  double limit_of(pugi::xml_node lanelet) const {
    if (const auto own = lanelet.child("speedLimit"))
      return file_.to_number(own.child_value(), own, 0.5, 100);
    for (const auto sign : lanelet.children("trafficSignRef"))
      if (const auto found = limits_.find(file_.text(sign, "ref"));
          found != limits_.end())
        return found->second;
    return usual_limit_mps;
  }

  void read_lanelet(pugi::xml_node lanelet) {
    const std::string name{file_.text(lanelet, "id")};
    if (!known_.emplace(name, closed).second)
      file_.refuse(lanelet,
                   fmt::format("there are two lanelets \"{}\".", name));
    for (const auto type : lanelet.children("laneletType"))
      if (std::ranges::find(closed_types, type.child_value())
          != closed_types.end()) {
        ++map_.left_out["lanes closed to cars"];
        return;
      }
    const auto middle =
        middle_of(bound(lanelet, "leftBound"), bound(lanelet, "rightBound"));
    if (middle.half_width_m < narrowest_lane_m
        || length_m(middle.centre) < 0.1) {
      ++map_.left_out["lanes narrower than 2 m"];
      return;
    }
    known_[name] = map_.lanes.size();
    source_lane made{.name = name,
                     .centre = middle.centre,
                     .half_width_m = middle.half_width_m};
    made.limit_mps = limit_of(lanelet);
    for (const auto sign : lanelet.children("trafficSignRef"))
      if (yield_signs_.contains(file_.text(sign, "ref")))
        yields_.insert(name);
    map_.lanes.push_back(std::move(made));
  }

  /// Some recordings count metres from far away.
  void move_to_middle() {
    point low{1e9, 1e9}, high{-1e9, -1e9};
    for (const auto& l : map_.lanes)
      for (const auto p : l.centre) {
        low = {std::min(low.x_m, p.x_m), std::min(low.y_m, p.y_m)};
        high = {std::max(high.x_m, p.x_m), std::max(high.y_m, p.y_m)};
      }
    const point middle{std::round((low.x_m + high.x_m) / 2),
                       std::round((low.y_m + high.y_m) / 2)};
    for (auto& l : map_.lanes)
      for (auto& p : l.centre)
        p = p - middle;
    map_.middle = middle;
  }

  /// Who comes by a lanelet that a sign tells to give way, and what follows it
  /// alone, comes after the others.
  void rank_lanes() {
    std::map<std::string_view, bool> gives_way; // all who lead to it
    for (const auto& l : map_.lanes)
      for (const auto& next : l.next)
        gives_way.try_emplace(next, true).first->second &=
            yields_.contains(l.name);
    for (auto& l : map_.lanes) {
      const auto after = gives_way.find(l.name);
      if (yields_.contains(l.name)
          || (after != gives_way.end() && after->second))
        l.rank = 1;
    }
  }

  void link(pugi::xml_node lanelet) {
    const auto from = known_.at(std::string{file_.text(lanelet, "id")});
    for (const auto successor : lanelet.children("successor")) {
      const std::string name{file_.text(successor, "ref")};
      const auto to = known_.find(name);
      if (to == known_.end())
        file_.refuse(successor,
                     fmt::format("there is no lanelet \"{}\".", name));
      if (from == closed || to->second == closed)
        continue;
      auto& next = map_.lanes[from].next;
      if (distance_m(map_.lanes[from].centre.back(),
                     map_.lanes[to->second].centre.front())
          > successor_joint_m)
        ++map_.left_out["connections between lanes that do not meet"];
      else if (from != to->second
               && std::ranges::find(next, name) == next.end()) {
        limits_of_roads_.count_link(successor, from, to->second);
        next.push_back(name);
      }
    }
  }

  static constexpr auto closed = static_cast<std::size_t>(-1);

  const xml_file& file_;
  road_limits limits_of_roads_;
  source_map map_;
  std::unordered_map<std::string_view, double> limits_; // of signs
  std::unordered_map<std::string, std::size_t> known_;  // lanelets → lanes
  std::set<std::string_view> yield_signs_;
  std::set<std::string> yields_; // lanelets with one
};

} // namespace

source_map read_commonroad(const xml_file& file) {
  return commonroad_reader{file}.read();
}

} // namespace sofof::maps
