// Checks what no single option of a scenario can tell.
#include "scenario/checks.hpp"

#include "base/options/spelling.hpp"
#include "scenario/placement.hpp"
#include "scenario/vehicle_schedule.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sofof::scenario {

namespace {

void check_routes(const scenario_definition& all, const toml_file& source) {
  std::vector<std::string_view> known;
  for (const auto& r : all.world->routes)
    known.push_back(r->name());
  for (std::size_t f = 0; f < all.fleets.size(); ++f) {
    const auto& names = all.fleets[f].routes;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (find_routes(*all.world, names[i]).empty())
        source.refuse(fmt::format("fleet.{}.routes.{}", f, i),
                      unknown_word("route on the map", names[i], known));
  }
}

void check_stations(const scenario_definition& all, const toml_file& source) {
  for (std::size_t f = 0; f < all.fleets.size(); ++f) {
    const auto& fleet = all.fleets[f];
    for (std::size_t g = 0; g < f; ++g) {
      const auto& other = all.fleets[g];
      const auto first = std::max(fleet.first_station, other.first_station);
      const auto last = std::min(fleet.first_station + fleet.count,
                                 other.first_station + other.count)
                        - 1;
      if (first <= last)
        source.refuse(
            fmt::format("fleet.{}.first_station", f),
            fmt::format("station {} is in fleet {} already; begin at {}.",
                        first, g, other.first_station + other.count));
    }
  }
}

/// Who reads an ITS message tells vehicles from providers by their numbers.
void check_provider_stations(const scenario_definition& all,
                             const toml_file& source) {
  constexpr auto first = provider_station(0).value();
  constexpr auto beyond = provider_station(provider_stations).value();
  for (std::size_t f = 0; f < all.fleets.size(); ++f) {
    const auto& fleet = all.fleets[f];
    if (fleet.first_station < beyond
        && fleet.first_station + fleet.count > first)
      source.refuse(
          fmt::format("fleet.{}.first_station", f),
          fmt::format("stations {} to {} are providers; begin lower, or at {}.",
                      first, beyond - 1, beyond));
  }
}

void check_obstacles(const scenario_definition& all, const toml_file& source) {
  const auto highest =
      obstacle_id(static_cast<std::uint32_t>(all.obstacles.size())).value();
  for (std::size_t f = 0; f < all.fleets.size(); ++f)
    if (all.fleets[f].first_station + all.fleets[f].count - 1 > highest)
      source.refuse(fmt::format("fleet.{}.first_station", f),
                    fmt::format("stations above {} are obstacles; begin lower.",
                                highest));
  for (const auto& v : place_vehicles(all)) {
    const auto box = v.body();
    for (std::size_t k = 0; k < all.obstacles.size(); ++k)
      if (const auto& one = all.obstacles[k];
          !one.moves() && overlap(box, one.box()))
        source.refuse(fmt::format("obstacle.{}", k),
                      fmt::format("vehicle {} would start on it.", v.station));
  }
}

/// Who is part of a chain needs the one before it, and one after it; and a
/// vehicle plans on while those before are late.
void check_chain(const scenario_definition& all, const toml_file& source) {
  for (std::size_t k = 0; k < all.services.size(); ++k) {
    const auto& type = *all.services[k];
    const auto needs = [&](std::string_view other, std::string_view why) {
      if (!find_service(all, other))
        source.refuse(fmt::format("service.{}.name", k),
                      fmt::format("\"{}\" {} the service \"{}\"; add it, or "
                                  "leave this one out.",
                                  type.name(), why, other));
    };
    if (!type.plans() && !type.follows().empty())
      needs(type.follows(), "gets its inputs from");
    for (const auto name : actors::service_type_names())
      if (actors::make_service_type(name)->follows() == type.name())
        needs(name, "has its results used by");
    if (type.plans() && type.options.per_input
        && find_service(all, type.follows()))
      source.refuse(fmt::format("service.{}.per_input", k),
                    fmt::format("nothing would be planned while \"{}\" gives "
                                "no results; leave it out: planning has a "
                                "period.",
                                type.follows()));
  }
}

/// Only who looks at the scene can be limited by it.
void check_scene_limits(const scenario_definition& all,
                        const toml_file& source) {
  for (std::size_t k = 0; k < all.services.size(); ++k) {
    const auto& type = *all.services[k];
    if (!type.options.latency_by_scene)
      continue;
    if (!type.plans())
      source.refuse(fmt::format("service.{}.max_latency", k),
                    "max_latency = \"scene\" is for trajectory_planning alone, "
                    "which looks at the scene; say a time.");
  }
}

/// Who gets inputs from a program, or runs one in place of it, names it.
void check_programs(const scenario_definition& all, const toml_file& source) {
  std::vector<std::string_view> programs;
  for (const auto& type : all.services)
    if (type->is_program())
      programs.push_back(type->name());
  const auto require = [&](const std::string& key, std::string_view name) {
    if (std::ranges::find(programs, name) == programs.end())
      source.refuse(key, unknown_word("[[service]] with a `command` here", name,
                                      programs));
  };
  for (std::size_t k = 0; k < all.services.size(); ++k)
    if (const auto used = all.services[k]->uses_results_of(); !used.empty())
      require(fmt::format("service.{}.input.service", k), used);
  for (std::size_t p = 0; p < all.providers.size(); ++p)
    for (std::size_t k = 0; k < all.providers[p].programs.size(); ++k)
      require(fmt::format("provider.{}.program.{}.service", p, k),
              all.providers[p].programs[k].service);
}

void check_services(const scenario_definition& all, const toml_file& source) {
  std::vector<std::string_view> names;
  for (const auto& type : all.services) {
    if (std::ranges::find(names, type->name()) != names.end())
      source.refuse(
          fmt::format("service.{}.name", names.size()),
          fmt::format("there are two services \"{}\".", type->name()));
    names.push_back(type->name());
  }
  check_chain(all, source);
  check_scene_limits(all, source);
  check_programs(all, source);
  // Nobody else tells a vehicle where to drive.
  if (!planning_service(all))
    source.refuse("service", "there is no service \"trajectory_planning\"; "
                             "vehicles need it to drive.");
  for (std::size_t p = 0; p < all.providers.size(); ++p) {
    const auto& offered = all.providers[p].services;
    for (std::size_t i = 0; i < offered.size(); ++i)
      if (std::ranges::find(names, offered[i]) == names.end())
        source.refuse(fmt::format("{}.services.{}", all.key_of(p), i),
                      unknown_word("[[service]] here", offered[i], names));
  }
}

void check_providers(const scenario_definition& all, const toml_file& source) {
  const auto& list = all.providers;
  for (auto p = list.begin(); p != list.end(); ++p)
    if (std::find_if(
            list.begin(), p,
            [&](const auto& earlier) { return earlier.name == p->name; })
        != p)
      source.refuse(all.key_of(static_cast<std::size_t>(p - list.begin()))
                        + ".name",
                    fmt::format("there are two providers \"{}\".", p->name));
}

constexpr auto more_room =
    "use fewer vehicles, or another start_m or spacing_m";

void check_placement(const scenario_definition& all, const toml_file& source) {
  const auto vehicles = place_vehicles(all);
  for (const auto& v : vehicles)
    if (v.off_its_way())
      source.refuse(
          fmt::format("fleet.{}", v.fleet),
          fmt::format("vehicle {} would start at {:.0f} m of \"{}\", which has "
                      "{:.0f} m; {}.",
                      v.station, v.start_s_m, v.way->name(), v.way->length_m(),
                      more_room));
  for (const auto& v : vehicles) {
    const auto start_mps = all.fleets[v.fleet].start_speed_mps;
    const auto limit_mps = v.way->limit_mps(v.start_s_m);
    if (start_mps > limit_mps && !all.fleets[v.fleet].start_over_limit)
      source.refuse(
          fmt::format("fleet.{}.start_speed_mps", v.fleet),
          fmt::format("vehicle {} would start with {} m/s at {:.0f} m of "
                      "\"{}\", where the limit is {} m/s.",
                      v.station, start_mps, v.start_s_m, v.way->name(),
                      limit_mps));
  }
  if (const auto near = find_too_near(vehicles)) {
    const auto& a = vehicles[near->first];
    const auto& b = vehicles[near->second];
    source.refuse(
        fmt::format("fleet.{}", b.fleet),
        fmt::format("vehicle {} at {:.0f} m of \"{}\" and vehicle {} at {:.0f} "
                    "m of \"{}\" would start less than {:.0f} m apart; {}.",
                    a.station, a.start_s_m, a.way->name(), b.station,
                    b.start_s_m, b.way->name(), min_start_gap_m, more_room));
  }
}

void check_own_cores(const scenario_definition& all, const toml_file& source) {
  for (std::size_t f = 0; f < all.fleets.size(); ++f) {
    const auto schedule = schedule_at_home(all, f);
    if (!schedule)
      continue;
    if (all.vehicle_host.cores > 0)
      source.refuse(fmt::format("fleet.{}.compute.scheduling", f),
                    "says that vehicles have cores of their own, and "
                    "[vehicle_host] that they have not; remove one of them.");
    if (const auto why = warning_of(*schedule);
        all.fleets[f].compute.strict && !why.empty())
      source.refuse(fmt::format("fleet.{}.compute.strict", f),
                    fmt::format("refuses this: {}", why));
  }
}

} // namespace

void check_whole(const scenario_definition& all, const toml_file& source) {
  if (all.fleets.empty())
    source.refuse("", "there are no vehicles: add a [[fleet]].");
  if (all.services.empty())
    source.refuse("",
                  fmt::format("there is no [[service]]; known are {}.",
                              fmt::join(actors::service_type_names(), ", ")));
  check_routes(all, source);
  check_stations(all, source);
  check_provider_stations(all, source);
  check_services(all, source);
  check_own_cores(all, source);
  check_providers(all, source);
  check_placement(all, source);
  check_obstacles(all, source);
  if (all.record.plans && !all.record.tracks)
    source.refuse("record.plans",
                  "needs tracks; leave out record.tracks = false.");
}

} // namespace sofof::scenario
