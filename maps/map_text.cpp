// A map, and a scenario of its departures, as TOML.
#include "base/options/toml_text.hpp"

#include <fmt/format.h>

#include "maps/imported_map.hpp"
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <string_view>

namespace sofof::maps {

namespace {

std::string list(const std::vector<std::string>& names) {
  std::string all;
  for (const auto& name : names) {
    if (!all.empty())
      all += ", ";
    all += quoted_toml(name);
  }
  return all;
}

void put(std::string& to, const world::lane& l) {
  auto out = std::back_inserter(to);
  fmt::format_to(out, "\n[[lane]]\nname = {}\nhalf_width_m = {:.2f}\n",
                 quoted_toml(l.name), l.half_width_m);
  if (l.rank != 0)
    fmt::format_to(out, "rank = {}\n", l.rank);
  to += "limits = [";
  for (const auto& zone : l.limits)
    fmt::format_to(out, "{}{{ from_m = {:.2f}, limit_mps = {:.2f} }}",
                   &zone == &l.limits.front() ? "" : ", ", zone.from_m,
                   zone.limit_mps);
  fmt::format_to(out, "]\nnext = [{}]\npoints_m = [", list(l.next));
  for (std::size_t i = 0; i < l.centre.size(); ++i)
    fmt::format_to(out, "{}[{:.3f}, {:.3f}]", i == 0 ? "" : ", ",
                   l.centre[i].x_m, l.centre[i].y_m);
  to += "]\n";
}

/// Routes of one name are told apart by numbers behind them.
std::vector<std::string> route_names(const imported_map& map) {
  std::vector<std::string> names;
  std::set<std::string> known;
  std::map<std::string_view, int> last; // number behind a name
  for (const auto& r : map.routes) {
    auto name = r.name;
    for (auto& i = last.try_emplace(r.name, 1).first->second;
         !known.insert(name).second;)
      name = fmt::format("{} {}", r.name, ++i);
    names.push_back(std::move(name));
  }
  return names;
}

} // namespace

std::string to_toml(const imported_map& map) {
  auto text = fmt::format("name = {}\n", quoted_toml(map.name));
  auto out = std::back_inserter(text);
  if (map.origin) {
    fmt::format_to(out,
                   "\n[origin]\nutm_zone = {}\nutm_e_m = {:.3f}\n"
                   "utm_n_m = {:.3f}\n",
                   map.origin->utm_zone, map.origin->utm_e_m,
                   map.origin->utm_n_m);
    if (map.origin->lat_deg != 0 || map.origin->lon_deg != 0)
      fmt::format_to(out, "lat_deg = {:.7f}\nlon_deg = {:.7f}\n",
                     map.origin->lat_deg, map.origin->lon_deg);
  }
  for (const auto& l : map.lanes)
    put(text, l);
  const auto names = route_names(map);
  for (std::size_t i = 0; i < names.size(); ++i)
    fmt::format_to(out, "\n[[route]]\nname = {}\nlanes = [{}]\n{}",
                   quoted_toml(names[i]), list(map.routes[i].lanes),
                   map.routes[i].closed ? "closed = true\n" : "");
  return text;
}

std::string to_scenario(const imported_map& map, const std::string& file) {
  const auto last_s = map.departures.empty() ? 0 : map.departures.back().at_s;
  constexpr auto to_arrive_s = 120.0;
  auto text = fmt::format("# The vehicles of the source, each when it departs "
                          "there.\n\nname = {}\nduration = \"{:.0f}s\"\n"
                          "map = {}\n",
                          quoted_toml(map.name),
                          std::ceil(last_s + to_arrive_s), quoted_toml(file));
  const auto names = route_names(map);
  auto station = 101;
  for (const auto& d : map.departures)
    fmt::format_to(std::back_inserter(text),
                   "\n[[fleet]] # {}\nfirst_station = {}\ncount = 1\n"
                   "routes = [{}]\nstart_m = 2.0\nappears_at = \"{:.0f}ms\"\n",
                   quoted_toml(d.vehicle), station++,
                   quoted_toml(names[d.route]), std::round(1000 * d.at_s));
  text += "\n[[service]]\nname = \"trajectory_planning\"\n";
  return text;
}

} // namespace sofof::maps
