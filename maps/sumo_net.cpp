// Reads a network of SUMO.
#include "maps/sumo_net.hpp"

#include <fmt/format.h>

#include "maps/road_limits.hpp"
#include "maps/split_words.hpp"
#include "maps/sumo_ranks.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

namespace sofof::maps {

namespace {

constexpr auto usual_width_m = 3.2; // of SUMO's lanes

/// Lanes that touch to within this are joined where they meet, m.
constexpr auto netconvert_joint_m = 2.0;

/// @returns whether a list of vehicle classes names passenger cars.
bool names_cars(std::string_view classes) {
  for (const auto one : split_words(classes))
    if (one == "passenger" || one == "all")
      return true;
  return false;
}

bool admits_cars(pugi::xml_node lane) {
  if (const auto allowed = lane.attribute("allow"))
    return names_cars(allowed.value());
  return !names_cars(lane.attribute("disallow").value());
}

class net_reader {
public:
  explicit net_reader(const xml_file& net) : net_{net}, limits_{net} {}

  source_map read() {
    find_frame();
    for (const auto edge : net_.root().children("edge"))
      read_edge(edge);
    for (const auto connection : net_.root().children("connection"))
      read_connection(connection);
    rank_lanes(net_, map_.lanes, index_);
    const auto signals =
        std::ranges::distance(net_.root().children("tlLogic").begin(),
                              net_.root().children("tlLogic").end());
    if (signals > 0)
      map_.left_out["traffic lights"] = static_cast<std::size_t>(signals);
    return std::move(map_);
  }

private:
  void find_frame() {
    const auto location = net_.root().child("location");
    if (!location)
      net_.refuse(net_.root(), "<net> needs a <location>.");
    const auto offset = numbers(location, "netOffset", 2);
    const auto box = numbers(location, "convBoundary", 4);
    middle_ = {std::round((box[0] + box[2]) / 2),
               std::round((box[1] + box[3]) / 2)};
    const std::string_view projection =
        location.attribute("projParameter").value();
    if (projection.find("+proj=utm") == projection.npos)
      return;
    if (projection.find("+south") != projection.npos) {
      map_.left_out[southern] = 1;
      return;
    }
    const auto zone = number_after(projection, "+zone=");
    const world::geo_origin origin{.utm_e_m = middle_.x_m - offset[0],
                                   .utm_n_m = middle_.y_m - offset[1],
                                   .utm_zone = zone};
    if (zone >= 1 && zone <= 60 && origin.utm_e_m >= 0 && origin.utm_e_m <= 1e6
        && origin.utm_n_m >= 0 && origin.utm_n_m <= 1e7)
      map_.origin = origin;
  }

  static int number_after(std::string_view text, std::string_view key) {
    const auto at = text.find(key);
    auto number = 0;
    for (auto i = at == text.npos ? text.size() : at + key.size();
         i < text.size() && number < 100 && text[i] >= '0' && text[i] <= '9';
         ++i)
      number = 10 * number + (text[i] - '0');
    return number;
  }

  std::vector<double> numbers(pugi::xml_node at, const char* attribute,
                              std::size_t count) const {
    std::vector<double> all;
    for (const auto word : split_words(net_.text(at, attribute), ','))
      all.push_back(net_.to_number(word, at));
    if (all.size() != count)
      net_.refuse(at,
                  fmt::format("\"{}\" needs {} numbers.", attribute, count));
    return all;
  }

  void read_edge(pugi::xml_node edge) {
    const std::string_view function = edge.attribute("function").value();
    const auto inside = function == "internal";
    if (!inside && !function.empty() && function != "normal") {
      if (function == "crossing" || function == "walkingarea")
        ++map_.left_out["footways"];
      return;
    }
    for (const auto lane : edge.children("lane")) {
      const std::string name{net_.text(lane, "id")};
      if (!known_.insert(name).second)
        net_.refuse(lane, fmt::format("there are two lanes \"{}\".", name));
      if (!admits_cars(lane)) {
        if (!inside)
          ++map_.left_out["lanes closed to cars"];
        continue;
      }
      source_lane l{.name = name, .centre = shape(lane), .inside = inside};
      l.limit_mps = std::max(net_.number(lane, "speed", 0, 1e3), 0.5);
      l.limit_mps = std::min(l.limit_mps, 100.0);
      l.half_width_m =
          net_.optional_number(lane, "width", 0.2, 100).value_or(usual_width_m)
          / 2;
      if (!inside)
        l.edges = {std::string{net_.text(edge, "id")}};
      index_.emplace(name, map_.lanes.size());
      map_.lanes.push_back(std::move(l));
    }
  }

  std::vector<point> shape(pugi::xml_node lane) {
    std::vector<point> points;
    for (const auto place : split_words(net_.text(lane, "shape"))) {
      const auto parts = split_words(place, ',');
      if (parts.size() < 2 || parts.size() > 3)
        net_.refuse(lane,
                    fmt::format("\"{}\" of its shape is no point.", place));
      points.push_back(
          point{net_.to_number(parts[0], lane), net_.to_number(parts[1], lane)}
          - middle_);
    }
    if (points.size() < 2)
      net_.refuse(lane, "the shape of a lane needs two points.");
    limits_.count_line(lane, points);
    return points;
  }

  /// @returns the lane of a connection's end; null if it is closed to cars.
  source_lane* lane_of(pugi::xml_node at, const std::string& name) {
    if (const auto found = index_.find(name); found != index_.end())
      return &map_.lanes[found->second];
    if (!known_.contains(name))
      net_.refuse(at, fmt::format("there is no lane \"{}\".", name));
    return nullptr;
  }

  void read_connection(pugi::xml_node c) {
    const auto end = [&](const char* edge, const char* number) {
      return fmt::format("{}_{}", net_.text(c, edge), net_.text(c, number));
    };
    if (is_elsewhere(c))
      return;
    auto* const from = lane_of(c, end("from", "fromLane"));
    auto* to = lane_of(c, end("to", "toLane"));
    if (!from || !to)
      return;
    if (std::string_view{c.attribute("dir").value()} == "t") {
      if (!from->inside)
        ++map_.left_out["U-turns"];
      return;
    }
    if (c.attribute("via"))
      to = lane_of(c, std::string{net_.text(c, "via")});
    if (!to)
      return;
    if (distance_m(from->centre.back(), to->centre.front())
        > netconvert_joint_m)
      ++map_.left_out["connections between lanes that do not meet"];
    else if (std::ranges::find(from->next, to->name) == from->next.end()) {
      limits_.count_link(c, number_of(from), number_of(to));
      from->next.push_back(to->name);
    }
  }

  std::size_t number_of(const source_lane* lane) const {
    return static_cast<std::size_t>(lane - map_.lanes.data());
  }

  /// Whether it joins footways.
  bool is_elsewhere(pugi::xml_node c) const {
    for (const auto* edge : {"from", "to"}) {
      const auto name = net_.text(c, edge);
      if (name.starts_with(':')
          && (name.find("_c") != name.npos || name.find("_w") != name.npos)
          && !known_.contains(fmt::format("{}_0", name)))
        return true;
    }
    return false;
  }

  const xml_file& net_;
  road_limits limits_;
  source_map map_;
  point middle_;
  std::unordered_set<std::string> known_; // lanes, closed ones included
  lane_numbers index_;
};

} // namespace

source_map read_sumo_net(const xml_file& net) {
  if (std::string_view{net.root().name()} != "net")
    net.refuse(net.root(), "this is no network of SUMO: <net> is missing.");
  return net_reader{net}.read();
}

} // namespace sofof::maps
