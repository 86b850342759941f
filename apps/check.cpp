// sofof check: reads a scenario and prints what it really says.
#include "apps/command.hpp"
#include "apps/scenario_arguments.hpp"
#include "scenario/schedulability.hpp"
#include "scenario/vehicle_schedule.hpp"
#include "world/roads/lane_overlaps.hpp"
#include "world/roads/sharp_bends.hpp"
#include "world/vehicle/vehicle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace sofof::apps {

namespace {

/// A car that leaves its lane in a corner brakes hard and nobody sees why.
void warn_of_sharp_bends(const scenario::scenario_definition& s) {
  const world::vehicle_params car;
  const auto least_radius_m = car.wheelbase_m / std::tan(car.max_steer_rad);
  for (const auto& bend :
       world::sharp_bends(s.world->map, s.world->routes, least_radius_m)) {
    constexpr auto degrees = 180 / std::numbers::pi;
    std::fputs(
        fmt::format("sofof: lane \"{}\" turns by {:.0f}° at ({:.2f}, {:.2f}), "
                    "with a radius of {:.1f} m; a car needs {:.1f} m, so none "
                    "can follow it.\n",
                    bend.lane, bend.turn_rad * degrees, bend.at.x_m,
                    bend.at.y_m, bend.radius_m, least_radius_m)
            .c_str(),
        stderr);
  }
}

/// Cars on one of them do not expect those on the other.
void warn_of_overlaps(const scenario::scenario_definition& s) {
  const auto& map = s.world->map;
  for (const auto& x : world::lane_overlaps(map))
    std::fputs(
        fmt::format("sofof: lanes \"{}\" and \"{}\" lie upon each other for "
                    "{:.1f} m at ({:.2f}, {:.2f}){}, but neither follows the "
                    "other; end one where the other begins, or move it.\n",
                    map.lanes()[x.lane_a].name, map.lanes()[x.lane_b].name,
                    x.length_m, x.at.x_m, x.at.y_m,
                    x.oncoming ? ", in opposite directions" : "")
            .c_str(),
        stderr);
}

/// Says how long results take at most, and warns where that is too long; once
/// of providers that are alike.
void tell_responses(const scenario::scenario_definition& s) {
  std::vector<scenario::provider_schedule> told;
  for (std::size_t p = 0; p < s.providers.size(); ++p) {
    auto schedule = scenario::schedule_of(s, p);
    const auto alike = std::ranges::find_if(
        told, [&](const auto& x) { return x.is_like(schedule); });
    if (alike == told.end())
      told.push_back(std::move(schedule));
    else
      ++alike->alike;
  }
  for (const auto& schedule : told) {
    std::cout << scenario::to_comment(schedule);
    if (const auto warning = scenario::warning_of(schedule, s);
        !warning.empty())
      std::cerr << "sofof: " << warning << '\n';
  }
}

/// Likewise of vehicles whose functions share cores.
void tell_own_responses(const scenario::scenario_definition& s) {
  for (std::size_t f = 0; f < s.fleets.size(); ++f) {
    const auto schedule = scenario::schedule_at_home(s, f);
    if (!schedule)
      continue;
    std::cout << scenario::to_comment(*schedule);
    if (const auto warning = scenario::warning_of(*schedule); !warning.empty())
      std::cerr << "sofof: " << warning << '\n';
  }
}

} // namespace

void add_check(CLI::App& app, int&) {
  auto* command = app.add_subcommand(
      "check", "Check a scenario and print its effective configuration");
  auto args = std::make_shared<scenario_arguments>();
  args->add_to(*command);
  command->footer("Example:\n  sofof check config/ulm_lehr.toml "
                  "--set network.profile=paper_5g");
  command->callback([args] {
    const auto s = args->load();
    warn_of_sharp_bends(s);
    warn_of_overlaps(s);
    std::cout << scenario::to_toml(s);
    tell_responses(s);
    tell_own_responses(s);
  });
}

} // namespace sofof::apps
