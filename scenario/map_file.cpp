// Reads a map: lanes, houses and named routes.
#include "scenario/map_file.hpp"

#include "base/options/option_helpers.hpp"
#include "base/options/toml_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

namespace sofof::scenario {

namespace {

constexpr option_visitor::range positive{1e-3, 1e6};

struct zone_entry : world::speed_zone {
  void visit_options(option_visitor& s) {
    s.field("from_m", from_m, {0, positive.max});
    s.field("limit_mps", limit_mps, {0.1, 100});
  }
};

struct lane_entry {
  world::lane is;

  void visit_options(option_visitor& s) {
    s.field("name", is.name);
    if (is.name.empty())
      s.refuse("name", "must not be empty.");
    s.field("half_width_m", is.half_width_m, {0.1, 100});
    auto rank = std::int64_t{is.rank};
    s.field("rank", rank, {0, 100});
    is.rank = static_cast<int>(rank);
    std::vector<zone_entry> zones{is.limits.begin(), is.limits.end()};
    visit_list(s, "limits", zones);
    is.limits.assign(zones.begin(), zones.end());
    s.field("next", is.next);
    s.field("opposite", is.opposite);
    s.field("points_m", is.centre);
  }
};

struct building_entry {
  world::building is;
  bool invented = false; // for the reader of the file

  void visit_options(option_visitor& s) {
    s.field("invented", invented);
    s.field("corners_m", is.corners);
    refuse_bad_polygon(s, "corners_m", is.corners);
  }
};

struct route_entry {
  std::string name;
  std::vector<std::string> lanes;
  bool closed = false;

  void visit_options(option_visitor& s) {
    s.field("name", name);
    if (name.empty())
      s.refuse("name", "must not be empty.");
    s.field("lanes", lanes);
    s.field("closed", closed);
  }
};

/// The file, as it is written.
struct map_entries {
  std::string name = "map";
  world::geo_origin origin;
  std::vector<lane_entry> lanes;
  std::vector<building_entry> buildings;
  std::vector<route_entry> routes;

  void visit_options(option_visitor& s) {
    s.field("name", name);
    s.table("origin", [this](option_visitor& t) { list_origin(t); });
    visit_list(s, "lane", lanes);
    visit_list(s, "building", buildings);
    visit_list(s, "route", routes);
  }

  void list_origin(option_visitor& t) {
    auto zone = std::int64_t{origin.utm_zone};
    t.field("utm_zone", zone, {1, 60});
    origin.utm_zone = static_cast<int>(zone);
    t.field("utm_e_m", origin.utm_e_m, {0, 1e6});
    t.field("utm_n_m", origin.utm_n_m, {0, 1e7});
    t.field("lat_deg", origin.lat_deg, {-90, 90});
    t.field("lon_deg", origin.lon_deg, {-180, 180});
  }
};

/// @returns a lane by itself, or with those that follow it, as a small map.
world::road_map part_of(const map_entries& all, std::size_t i, bool with_next) {
  std::vector<world::lane> lanes{all.lanes[i].is};
  const auto next = std::exchange(lanes[0].next, {});
  const auto opposite = std::exchange(lanes[0].opposite, {});
  if (with_next) {
    for (std::size_t j = 0; j < all.lanes.size(); ++j) {
      const auto& other = all.lanes[j].is;
      if (j == i
          || (other.name != opposite
              && std::ranges::find(next, other.name) == next.end()))
        continue;
      lanes.push_back(other);
      lanes.back().next.clear();
      lanes.back().opposite.clear();
    }
    lanes[0].next = next;
    lanes[0].opposite = opposite;
  }
  return {all.name, all.origin, std::move(lanes)};
}

/// Finds out which lane is to blame for what is wrong with the map.
[[noreturn]] void blame(const map_entries& all, const toml_file& source,
                        const std::invalid_argument& problem) {
  std::set<std::string> names;
  for (const auto with_next : {false, true}) {
    for (std::size_t i = 0; i < all.lanes.size(); ++i) {
      if (!with_next && !names.insert(all.lanes[i].is.name).second)
        source.refuse(fmt::format("lane.{}.name", i), problem.what());
      try {
        part_of(all, i, with_next);
      } catch (const std::invalid_argument& its_own) {
        source.refuse(fmt::format("lane.{}", i), its_own.what());
      }
    }
  }
  source.refuse("", problem.what());
}

world::road_map build_map(const map_entries& all, const toml_file& source) {
  std::vector<world::lane> lanes;
  for (const auto& entry : all.lanes)
    lanes.push_back(entry.is);
  std::vector<world::building> buildings;
  for (const auto& entry : all.buildings)
    buildings.push_back(entry.is);
  try {
    return {all.name, all.origin, std::move(lanes), std::move(buildings)};
  } catch (const std::invalid_argument& problem) {
    blame(all, source, problem);
  }
}

} // namespace

world::streets_ptr parse_map(std::string_view text,
                             const std::filesystem::path& file) {
  toml_file source{text, file.string()};
  map_entries all;
  source.read([&](option_visitor& s) { all.visit_options(s); });
  if (all.lanes.empty())
    source.refuse("", "the map has no [[lane]].");
  world::streets result{build_map(all, source), {}};
  for (std::size_t i = 0; i < all.routes.size(); ++i) {
    const auto& [name, lanes, closed] = all.routes[i];
    const auto key = fmt::format("route.{}.", i);
    if (result.find(name))
      source.refuse(key + "name", "there are two routes of this name.");
    try {
      result.routes.push_back(result.map.make_route(name, lanes, closed));
    } catch (const std::invalid_argument& problem) {
      source.refuse(key + "lanes", problem.what());
    }
  }
  return std::make_shared<const world::streets>(std::move(result));
}

void list_map_options(option_visitor& s) {
  map_entries all;
  all.visit_options(s);
}

} // namespace sofof::scenario
