// Makes a map of SOFOF of one of another format.
#include "maps/import.hpp"

#include "base/input_error.hpp"

#include <fmt/format.h>

#include "maps/commonroad.hpp"
#include "maps/lane_network.hpp"
#include "maps/lanelet2.hpp"
#include "maps/road_limits.hpp"
#include "maps/smooth_lanes.hpp"
#include "maps/sumo_net.hpp"
#include "maps/ways.hpp"
#include <algorithm>
#include <stdexcept>
#include <utility>

namespace sofof::maps {

namespace {

/// @returns whether it has what only Lanelet2 writes.
bool has_lanelets(pugi::xml_node osm) {
  for (const auto relation : osm.children("relation"))
    for (const auto tag : relation.children("tag"))
      if (std::string_view{tag.attribute("k").value()} == "type"
          && std::string_view{tag.attribute("v").value()} == "lanelet")
        return true;
  return false;
}

[[noreturn]] void refuse_format(const xml_file& file, const std::string& path) {
  const std::string_view kind = file.root().name();
  const auto use = [&](std::string_view what, std::string_view option) {
    file.refuse(file.root(),
                fmt::format("this is {}; make a network of SUMO of it first: "
                            "netconvert {} {} -o FILE.net.xml",
                            what, option, path));
  };
  if (kind == "OpenDRIVE")
    use("OpenDRIVE", "--opendrive-files");
  if (kind == "osm")
    use("OpenStreetMap without lanelets",
        "--geometry.remove --junctions.join --tls.guess-signals --osm-files");
  if (kind == "routes")
    file.refuse(file.root(), "these are routes; give the network first, and "
                             "them with --routes.");
  file.refuse(file.root(),
              fmt::format("<{}> is none of <net> (SUMO), <osm> (Lanelet2) and "
                          "<commonRoad>.",
                          kind));
}

source_map read(const xml_file& file, const std::string& path) {
  const std::string_view kind = file.root().name();
  if (kind == "net")
    return read_sumo_net(file);
  if (kind == "osm" && has_lanelets(file.root()))
    return read_lanelet2(file);
  if (kind == "commonRoad")
    return read_commonroad(file);
  refuse_format(file, path);
}

void find_routes(const source_map& source, const std::vector<drawn_lane>& lanes,
                 imported_map& to) {
  const way_finder ways{source, lanes};
  constexpr auto none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> numbers;
  for (const auto& route : source.routes) {
    auto way = ways.lanes_for(route);
    numbers.push_back(way ? to.routes.size() : none);
    if (way)
      to.routes.push_back({route.name, std::move(*way)});
    else
      ++to.left_out["routes that need a lane change or a closed lane"];
  }
  for (auto d : source.departures) {
    d.route = numbers[d.route];
    if (d.route != none)
      to.departures.push_back(std::move(d));
    else
      ++to.left_out["vehicles on these"];
  }
}

/// One sentence for all of them: a city may have dozens.
void warn_of_bends(const std::vector<drawn_lane>& lanes, imported_map& to) {
  std::string names;
  auto count = 0;
  auto sharpest_1pm = 0.0;
  for (const auto& l : lanes)
    if (!l.is_drivable()) {
      names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", l.is.name);
      to.too_sharp.push_back(l.is.name);
      sharpest_1pm = std::max(sharpest_1pm, l.sharpest_1pm);
      ++count;
    }
  if (count > 0)
    to.warnings.push_back(fmt::format(
        "no car can follow {} of {} lanes, and no way leads over them: a car "
        "needs a radius of {:.1f} m, they bend with down to {:.1f} m: {}.",
        count, lanes.size(), 1 / sharpest_drivable_1pm, 1 / sharpest_1pm,
        names));
}

} // namespace

imported_map import(const named_text& map, const std::string& name,
                    const named_text& routes) {
  const xml_file file{map.text, map.file};
  auto source = read(file, map.file);
  if (!routes.file.empty()) {
    if (std::string_view{file.root().name()} != "net")
      throw input_error{fmt::format("{}: routes belong to a network of SUMO; "
                                    "leave out --routes.",
                                    map.file)};
    read_sumo_routes(xml_file{routes.text, routes.file}, source);
  }
  tidy(source);
  if (source.lanes.empty())
    file.refuse(file.root(), "no lane is left that cars may drive.");
  for (const auto& l : source.lanes)
    if (length_m(l.centre) > longest_lane_m)
      file.refuse(file.root(),
                  fmt::format("lane \"{}\" is {:.0f} km long; {:.0f} km are "
                              "the most.",
                              l.name, length_m(l.centre) / 1000,
                              longest_lane_m / 1000));
  imported_map to{.name = name, .origin = source.origin};
  to.middle = source.middle;
  try {
    const auto lanes = draw_lanes(source);
    for (const auto& l : lanes)
      to.lanes.push_back(l.is);
    warn_of_bends(lanes, to);
    to.left_out = source.left_out;
    if (routes.file.empty())
      to.routes = propose_ways(source, lanes);
    else
      find_routes(source, lanes, to);
  } catch (const std::invalid_argument& problem) {
    throw input_error{fmt::format("{}: {}", map.file, problem.what())};
  }
  return to;
}

} // namespace sofof::maps
