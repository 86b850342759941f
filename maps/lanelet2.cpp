// Reads a Lanelet2 map.
#include "maps/lanelet2.hpp"

#include <fmt/format.h>

#include "maps/bounds.hpp"
#include "maps/road_limits.hpp"
#include <GeographicLib/UTMUPS.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace sofof::maps {

namespace {

constexpr auto kmh = 1 / 3.6;

/// Subtypes of lanelets that cars drive on.
constexpr std::array<std::string_view, 5> roads{
    "road", "highway", "play_street", "exit", "bus_lane"};
constexpr std::string_view of_buses = "bus_lane";

constexpr auto narrowest_m = 1.0; // half of it

/// Half the width of a lanelet in which two cars pass each other.
constexpr auto wide_m = 2.3;

std::string_view tag(pugi::xml_node of, std::string_view key) {
  for (const auto t : of.children("tag"))
    if (key == t.attribute("k").value())
      return t.attribute("v").value();
  return {};
}

/// Two lines of nodes, in driving order, left on the left.
struct lanelet {
  std::string name;
  pugi::xml_node at;
  std::vector<std::string_view> left, right; // ids of nodes
};

using node_pair = std::pair<std::string_view, std::string_view>;

class lanelet_reader {
public:
  explicit lanelet_reader(const xml_file& osm) : osm_{osm}, limits_{osm} {}

  source_map read() {
    place_nodes();
    for (const auto way : osm_.root().children("way"))
      ways_.emplace(osm_.text(way, "id"), way);
    for (const auto relation : osm_.root().children("relation"))
      if (tag(relation, "type") == "lanelet")
        read_lanelet(relation);
    link();
    for (const auto relation : osm_.root().children("relation"))
      if (tag(relation, "type") == "regulatory_element")
        read_rule(relation);
    return std::move(map_);
  }

private:
  void place_nodes() {
    const auto nodes = osm_.root().children("node");
    if (nodes.begin() == nodes.end())
      osm_.refuse(osm_.root(), "there is no <node>.");
    if (!tag(*nodes.begin(), "local_x").empty())
      for (const auto node : nodes)
        nodes_.emplace(osm_.text(node, "id"),
                       point{osm_.to_number(tag(node, "local_x"), node),
                             osm_.to_number(tag(node, "local_y"), node)});
    else
      project(nodes);
    move_to_middle();
  }

  void project(pugi::xml_object_range<pugi::xml_named_node_iterator> nodes) {
    auto zone = static_cast<int>(GeographicLib::UTMUPS::STANDARD);
    auto all_north = true;
    for (const auto node : nodes) {
      const auto lat = osm_.number(node, "lat", -79, 83);
      const auto lon = osm_.number(node, "lon", -180, 180);
      point at;
      auto is_north = true;
      try {
        GeographicLib::UTMUPS::Forward(lat, lon, zone, is_north, at.x_m, at.y_m,
                                       zone);
        if (!is_north)
          at.y_m -= GeographicLib::UTMUPS::UTMShift(); // goes on at the equator
      } catch (const GeographicLib::GeographicErr&) {
        osm_.refuse(node, "this node is too far from the others.");
      }
      all_north = all_north && is_north;
      nodes_.emplace(osm_.text(node, "id"), at);
    }
    if (all_north)
      map_.origin = world::geo_origin{.utm_zone = zone};
    else
      map_.left_out[southern] = 1;
  }

  void move_to_middle() {
    point low{1e9, 1e9}, high{-1e9, -1e9};
    for (const auto& [id, p] : nodes_) {
      low = {std::min(low.x_m, p.x_m), std::min(low.y_m, p.y_m)};
      high = {std::max(high.x_m, p.x_m), std::max(high.y_m, p.y_m)};
    }
    const point middle{std::round((low.x_m + high.x_m) / 2),
                       std::round((low.y_m + high.y_m) / 2)};
    for (auto& [id, p] : nodes_)
      p = p - middle;
    if (map_.origin) {
      map_.origin->utm_e_m = middle.x_m;
      map_.origin->utm_n_m = middle.y_m;
    }
  }

  /// A bound may consist of several ways, each drawn in either direction.
  std::vector<std::string_view> line(pugi::xml_node relation,
                                     std::string_view role) {
    std::vector<std::string_view> ids;
    auto ways = 0;
    for (const auto member : relation.children("member")) {
      if (role != member.attribute("role").value())
        continue;
      const auto way = ways_.find(osm_.text(member, "ref"));
      if (way == ways_.end())
        osm_.refuse(member, fmt::format("there is no way \"{}\".",
                                        osm_.text(member, "ref")));
      auto more = nodes_of(way->second);
      const auto meets = [&more](std::string_view end) {
        return more.front() == end || more.back() == end;
      };
      if (++ways == 2 && !meets(ids.back()))
        std::ranges::reverse(ids);
      if (ways > 1 && !meets(ids.back()))
        osm_.refuse(member, fmt::format("way \"{}\" of the {} bound does not "
                                        "begin where the one before it ends.",
                                        osm_.text(member, "ref"), role));
      if (ways > 1 && more.front() != ids.back())
        std::ranges::reverse(more);
      ids.insert(ids.end(), more.begin() + (ways > 1 ? 1 : 0), more.end());
      if (ids.size() > most_points)
        break;
    }
    if (ids.size() < 2)
      osm_.refuse(relation, fmt::format("the lanelet needs a {} bound.", role));
    limits_.count_line(relation, points(ids));
    return ids;
  }

  std::vector<std::string_view> nodes_of(pugi::xml_node way) const {
    std::vector<std::string_view> ids;
    for (const auto nd : way.children("nd")) {
      const auto id = osm_.text(nd, "ref");
      if (!nodes_.contains(id))
        osm_.refuse(nd, fmt::format("there is no node \"{}\".", id));
      ids.push_back(id);
      if (ids.size() > most_points)
        osm_.refuse(way,
                    fmt::format("a bound has {} nodes at most.", most_points));
    }
    if (ids.size() < 2)
      osm_.refuse(way, "a bound needs two nodes.");
    return ids;
  }

  std::vector<point> points(const std::vector<std::string_view>& ids) const {
    std::vector<point> all;
    for (const auto id : ids)
      all.push_back(nodes_.at(id));
    return all;
  }

  void read_lanelet(pugi::xml_node relation) {
    const auto subtype = tag(relation, "subtype");
    if (std::ranges::find(roads, subtype) == roads.end()) {
      ++map_.left_out["lanelets that are no road"];
      return;
    }
    const auto cars = tag(relation, "participant:vehicle");
    if (subtype == of_buses || cars == "no") {
      ++map_.left_out["lanes closed to cars"];
      return;
    }
    const std::string name{osm_.text(relation, "id")};
    know(relation, name);
    auto left = line(relation, "left"), right = line(relation, "right");
    orient(left, right);
    const auto both_ways = tag(relation, "one_way") == "no";
    add(relation, {name, relation, left, right}, both_ways);
    if (!both_ways)
      return;
    std::ranges::reverse(left);
    std::ranges::reverse(right);
    know(relation, name + " back");
    add(relation, {name + " back", relation, right, left}, both_ways);
  }

  void know(pugi::xml_node relation, const std::string& name) {
    if (!known_.insert(name).second)
      osm_.refuse(relation,
                  fmt::format("there are two lanelets \"{}\".", name));
  }

  /// Bounds are drawn in either direction: here they run beside each other,
  /// the left one on the left.
  void orient(std::vector<std::string_view>& left,
              std::vector<std::string_view>& right) const {
    const auto at = [&](std::string_view id) { return nodes_.at(id); };
    const auto far_m = [&](std::string_view a, std::string_view b) {
      return distance_m(at(a), at(b));
    };
    if (far_m(left.front(), right.front()) + far_m(left.back(), right.back())
        > far_m(left.front(), right.back()) + far_m(left.back(), right.front()))
      std::ranges::reverse(right);
    auto area = 0.0; // of the rim: left, and right back
    auto rim = points(left);
    const auto other = points(right);
    rim.insert(rim.end(), other.rbegin(), other.rend());
    for (std::size_t i = 0; i < rim.size(); ++i)
      area += cross(rim[i], rim[(i + 1) % rim.size()]);
    if (area > 0) { // counter-clockwise: left is on the right
      std::ranges::reverse(left);
      std::ranges::reverse(right);
    }
  }

  /// Who shares a wide lanelet with oncoming traffic keeps to the right half.
  void add(pugi::xml_node relation, lanelet l, bool both_ways) {
    auto middle = middle_of(points(l.left), points(l.right));
    if (both_ways && middle.half_width_m >= wide_m)
      middle = middle_of(middle.centre, points(l.right));
    if (middle.half_width_m < narrowest_m || length_m(middle.centre) < 0.1) {
      ++map_.left_out["lanes narrower than 2 m"];
      return;
    }
    source_lane made{.name = l.name,
                     .centre = middle.centre,
                     .half_width_m = middle.half_width_m};
    made.limit_mps = limit_of(relation);
    by_name_.emplace(l.name, map_.lanes.size());
    map_.lanes.push_back(std::move(made));
    lanelets_.push_back(std::move(l));
  }

  /// "50", "50 km/h" or "30 mph".
  double limit_of(pugi::xml_node relation) const {
    const auto text = tag(relation, "speed_limit");
    auto speed = 0.0;
    if (text.empty())
      return (tag(relation, "location") == "nonurban" ? 100 : 50) * kmh;
    const auto [rest, problem] =
        std::from_chars(text.data(), text.data() + text.size(), speed);
    const std::string_view unit{rest, text.data() + text.size()};
    constexpr auto mph = 0.44704;
    const auto scale = unit.find("mph") != unit.npos   ? mph
                       : unit.find("m/s") != unit.npos ? 1.0
                                                       : kmh;
    if (problem != std::errc{} || !(speed * scale > 0.5)
        || !(speed * scale < 100))
      osm_.refuse(relation, fmt::format("\"{}\" is no speed limit.", text));
    return speed * scale;
  }

  void link() {
    std::map<node_pair, std::vector<std::size_t>> starts;
    for (std::size_t i = 0; i < lanelets_.size(); ++i)
      starts[{lanelets_[i].left.front(), lanelets_[i].right.front()}].push_back(
          i);
    for (std::size_t i = 0; i < lanelets_.size(); ++i) {
      const auto& l = lanelets_[i];
      const auto found = starts.find({l.left.back(), l.right.back()});
      if (found == starts.end())
        continue;
      for (const auto j : found->second)
        if (j != i) {
          limits_.count_link(l.at, i, j);
          map_.lanes[i].next.push_back(map_.lanes[j].name);
        }
    }
  }

  void read_rule(pugi::xml_node rule) {
    const auto subtype = tag(rule, "subtype");
    if (subtype == "traffic_light")
      ++map_.left_out["traffic lights"];
    if (subtype != "right_of_way")
      return;
    for (const auto member : rule.children("member"))
      if (std::string_view{member.attribute("role").value()} == "yield")
        if (const auto found =
                by_name_.find(std::string{osm_.text(member, "ref")});
            found != by_name_.end())
          map_.lanes[found->second].rank = 1;
  }

  const xml_file& osm_;
  road_limits limits_;
  source_map map_;
  std::unordered_map<std::string_view, point> nodes_;
  std::unordered_map<std::string_view, pugi::xml_node> ways_;
  std::unordered_map<std::string, std::size_t> by_name_;
  std::unordered_set<std::string> known_; // lanelets, too narrow ones as well
  std::vector<lanelet> lanelets_;         // of each lane
};

} // namespace

source_map read_lanelet2(const xml_file& osm) {
  return lanelet_reader{osm}.read();
}

} // namespace sofof::maps
