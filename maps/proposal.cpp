// A first scenario on a map.
#include "maps/proposal.hpp"

#include "base/options/toml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace sofof::maps {

namespace {

constexpr auto same_junction_m = 40.0;
constexpr auto area_m = 250.0; // radius
constexpr std::size_t most_providers = 3;
constexpr auto cars = 20;

/// How many routes lead over each lane.
std::vector<double> routes_over(const world::streets& world) {
  std::vector<double> count(world.map.lanes().size(), 0);
  for (const auto& route : world.routes)
    for (const auto lane : route->sequence())
      ++count[lane];
  return count;
}

void put_fleet(std::string& text, const std::vector<std::string>& routes,
               int count, int first_station, bool closed) {
  std::string names;
  for (const auto& name : routes)
    names += (names.empty() ? "" : ", ") + quoted_toml(name);
  fmt::format_to(std::back_inserter(text),
                 "\n[[fleet]]\ncount = {}\nfirst_station = {}\nroutes = [{}]\n"
                 "{}",
                 count, first_station, names,
                 closed ? ""
                        : "placement = \"convoy\"    # all from the begins of "
                          "their routes,\nspacing_m = 0.0\nstart_m = 5.0\n"
                          "appear_every = \"3s\"     # one after the other\n");
}

} // namespace

std::vector<junction> busiest_junctions(const world::streets& world,
                                        std::size_t most, double apart_m) {
  const auto over = routes_over(world);
  std::vector<junction> all;
  for (const auto& c : world.map.conflicts()) {
    if (c.how != world::conflict::kind::crossing)
      continue;
    const auto& lane = world.map.lanes()[c.lane_a];
    const auto at = world::path{lane.centre}.at((c.from_a_m + c.to_a_m) / 2).at;
    const auto near = std::ranges::find_if(all, [at](const junction& j) {
      return distance_m(j.at, at) < same_junction_m;
    });
    auto& j = near != all.end() ? *near : all.emplace_back(at, 0, lane.name);
    j.ways += over[c.lane_a] + over[c.lane_b];
  }
  std::ranges::stable_sort(all, std::greater{}, &junction::ways);
  std::vector<junction> kept;
  for (const auto& j : all)
    if (kept.size() < most
        && std::ranges::none_of(kept, [&](const junction& other) {
             return distance_m(j.at, other.at) < apart_m;
           }))
      kept.push_back(j);
  return kept;
}

std::string propose_scenario(const world::streets& world, std::string_view name,
                             std::string_view map) {
  std::vector<std::string> open, closed;
  for (const auto& r : world.routes)
    (r->closed() ? closed : open).push_back(r->name());
  if (open.empty() && closed.empty())
    throw std::invalid_argument{"The map has no [[route]]: vehicles need one."};
  auto text = fmt::format("name = {}\nduration = \"300s\"\nseed = 1\nmap = {}\n"
                          "\n[traffic]\ncrossings = \"granted\"\n",
                          quoted_toml(name), quoted_toml(map));
  const auto all = static_cast<double>(open.size() + closed.size());
  const auto rounds =
      static_cast<int>(cars * static_cast<double>(closed.size()) / all);
  if (rounds > 0)
    put_fleet(text, closed, rounds, 101, true);
  if (!open.empty())
    put_fleet(text, open, cars - rounds, 101 + rounds, false);
  auto junctions = busiest_junctions(world, most_providers, 1.5 * area_m);
  if (junctions.empty())
    junctions.push_back({world.routes.front()->path().at(0).at, 0, {}});
  for (std::size_t i = 0; i < junctions.size(); ++i)
    fmt::format_to(std::back_inserter(text),
                   "\n[[provider]]\nname = \"edge {}\"\nposition_m = [{:.1f}, "
                   "{:.1f}]\narea_radius_m = {:.1f}\n",
                   i + 1, junctions[i].at.x_m, junctions[i].at.y_m, area_m);
  text += "\n[compute]\nworkers = 2    # of each provider\n"
          "\n[[service]]\nname = \"trajectory_planning\"\n";
  return text;
}

} // namespace sofof::maps
