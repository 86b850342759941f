// One experiment: everything that a scenario file can say, with defaults.
#include "scenario/scenario.hpp"

#include "base/options/option_helpers.hpp"
#include "base/options/option_printer.hpp"
#include "base/protocol.hpp"
#include "policies/governors/governors.hpp"
#include "policies/registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

namespace sofof {

using namespace std::chrono_literals;

namespace {

constexpr option_visitor::range any_length_m{0, 1e6};
constexpr option_visitor::range any_heading_deg{-360, 360};
constexpr option_visitor::range body_size_m{0.1, 50};
constexpr std::array<std::string_view, 2> placements{"convoy", "equal"};
constexpr std::array<std::string_view, 2> crossing_rules{"granted",
                                                         "perceived"};
constexpr auto max_vehicles = 1e5;
constexpr auto max_start_speed_mps = 50.0;
constexpr double max_station = std::numeric_limits<station_id>::max();

double to_rad(double angle_deg) {
  return angle_deg * std::numbers::pi / 180;
}

/// @returns where a name belongs that is no policy of the side where it stands;
/// nothing for one that nobody has.
std::string right_place(std::string_view name) {
  if (make_lodm(name))
    return fmt::format("It is an LODM: lodm = \"{}\".", name);
  if (make_codm(name))
    return fmt::format("It is a CODM: codm = \"{}\".", name);
  if (make_governor(name))
    return fmt::format(
        "It is a governor: lodm = {{ name = \"location\", govern = "
        "[{{ name = \"{}\" }}] }}.",
        name);
  return {};
}

} // namespace

void fleet_options::visit_options(option_visitor& s) {
  s.field("count", count, {1, max_vehicles});
  s.field("first_station", first_station, {1, max_station});
  if (static_cast<double>(first_station + count - 1) > max_station)
    s.refuse("first_station", "leaves too few numbers for all its vehicles.");
  s.field("routes", routes);
  if (routes.empty())
    s.refuse("routes", "must name at least one route.");
  s.field("placement", placement);
  if (std::ranges::find(placements, placement) == placements.end())
    s.refuse("placement", unknown_word("placement", placement, placements));
  s.field("spacing_m", spacing_m, any_length_m);
  s.field("start_m", start_m, any_length_m);
  s.field("start_speed_mps", start_speed_mps, {0, max_start_speed_mps});
  s.field("connected", connected);
  s.field("appears_at", appears_at, 0ns);
  s.field("appear_every", appear_every, 0ns);
  s.table("computer", [this](option_visitor& t) { computer.visit_options(t); });
}

void traffic_options::visit_options(option_visitor& s) {
  s.field("crossings", crossings);
  if (std::ranges::find(crossing_rules, crossings) == crossing_rules.end())
    s.refuse("crossings",
             unknown_word("rule for crossings", crossings, crossing_rules));
}

oriented_box obstacle_options::box() const {
  return {position_m, to_rad(heading_deg), length_m, width_m};
}

void obstacle_options::visit_options(option_visitor& s) {
  s.field("position_m", position_m);
  s.field("heading_deg", heading_deg, any_heading_deg);
  s.field("length_m", length_m, body_size_m);
  s.field("width_m", width_m, body_size_m);
}

sensor roadside_options::make(random_stream noise) const {
  return {can, noise, position_m, to_rad(heading_deg), std::nullopt};
}

void roadside_options::visit_options(option_visitor& s) {
  s.field("position_m", position_m);
  s.field("heading_deg", heading_deg, any_heading_deg);
  can.visit_options(s);
}

polygon provider_options::area() const {
  if (!area_m.empty())
    return polygon{area_m};
  return polygon::regular(position_m, area_radius_m,
                          static_cast<unsigned>(area_corners));
}

bool provider_options::offers(std::string_view service) const {
  return services.empty()
         || std::ranges::find(services, service) != services.end();
}

void provider_options::visit_options(option_visitor& s) {
  s.field("name", name);
  if (name.empty())
    s.refuse("name", "must not be empty.");
  s.field("position_m", position_m);
  if (s.has("area_m", !area_m.empty())) {
    s.field("area_m", area_m);
    refuse_bad_polygon(s, "area_m", area_m);
    for (const auto key : {"area_radius_m", "area_corners"})
      if (s.has(key, false))
        s.refuse(key, "has no effect beside area_m; remove one of them.");
  } else {
    s.field("area_radius_m", area_radius_m, {1, any_length_m.max});
    s.field("area_corners", area_corners, {3, 1000});
  }
  s.field("range_m", range_m, any_length_m);
  if (s.has("services", !services.empty())) {
    s.field("services", services);
    if (services.empty())
      s.refuse("services", "must name at least one service; leave it out to "
                           "offer all.");
  }
  visit_list(s, "sensor", sensors);
  if (s.has("fails_at", fails_at.has_value()))
    s.field("fails_at", fails_at ? *fails_at : fails_at.emplace(), 1ns);
  if (s.has("returns_at", returns_at.has_value())) {
    s.field("returns_at", returns_at ? *returns_at : returns_at.emplace(), 1ns);
    if (!fails_at)
      s.refuse("returns_at", "has no effect without fails_at.");
    else if (*returns_at <= *fails_at)
      s.refuse("returns_at", "must be later than fails_at.");
  }
  if (s.has("radio", !radio.empty()))
    s.field("radio", radio);
  if (s.has("network", network.has_value()))
    s.table("network", [this](option_visitor& t) {
      if (!network)
        network.emplace();
      network->visit_options(t);
      if (network->channel && network->channel->replays)
        t.refuse("profile", "replays a file, which only [network] can.");
    });
}

void network_options::visit_options(option_visitor& s) {
  s.field("profile", profile);
  const auto known = find_channel_profile(profile);
  if (!known)
    return s.refuse("profile", unknown_word("channel profile", profile,
                                            channel_profile_names()));
  if (s.has("trace", !trace.empty())) {
    s.field("trace", trace);
    if (!known->replays)
      s.refuse("trace", "has no effect with this profile; use \"trace\".");
    if (trace.empty())
      s.refuse("trace", "must name a file.");
  } else if (known->replays) {
    s.refuse("profile", "needs a file to replay: add trace = \"FILE\".");
  }
  auto options = channel && channel->name == profile ? *channel : *known;
  options.visit_options(s);
  channel = std::make_shared<const channel_profile>(std::move(options));
}

policy_options::policy_options()
    : lodm{make_lodm("location")}, codm{make_codm("location")} {}

void policy_options::visit_options(option_visitor& s) {
  s.table("lodm", [this](option_visitor& t) {
    visit_choice(t, lodm, make_lodm, "LODM policy", lodm_names(), right_place);
  });
  s.table("codm", [this](option_visitor& t) {
    visit_choice(t, codm, make_codm, "CODM policy", codm_names(), right_place);
  });
}

void record_options::visit_options(option_visitor& s) {
  s.field("tracks_period", tracks_period, protocol::control_period);
  if (tracks_period % protocol::control_period != 0ns)
    s.refuse("tracks_period", "must be a multiple of \"10ms\", a vehicle's "
                              "step.");
  s.field("cycles", cycles);
  s.field("margins", margins);
  s.field("tracks", tracks);
}

const std::shared_ptr<const channel_profile>&
scenario::channel_to(std::size_t place) const {
  const auto& own = providers[place].network;
  return own ? own->channel : network.channel;
}

std::string scenario::profiles() const {
  std::vector<std::string_view> names;
  for (const auto& p : providers) {
    const std::string_view name =
        p.network ? p.network->profile : network.profile;
    if (std::ranges::find(names, name) == names.end())
      names.push_back(name);
  }
  return names.empty() ? network.profile
                       : fmt::format("{}", fmt::join(names, ", "));
}

void scenario::visit_options(option_visitor& s) {
  s.field("name", name);
  s.field("duration", length, 1ns);
  constexpr double max_seed = 0x1p63; // no int64 exceeds it
  s.field("seed", seed, {0, max_seed});
  if (s.has("map", !map_file.empty()))
    s.field("map", map_file);
  grid = s.has("street_grid", grid);
  if (grid)
    s.table("street_grid",
            [this](option_visitor& t) { grid_params.visit_options(t); });
  s.table("traffic", [this](option_visitor& t) { traffic.visit_options(t); });
  visit_list(s, "fleet", fleets);
  s.table("sensors", [this](option_visitor& t) { sensors.visit_options(t); });
  visit_list(s, "obstacle", obstacles);
  visit_list(s, "provider", providers);
  s.table("network", [this](option_visitor& t) { network.visit_options(t); });
  s.table("v2x", [this](option_visitor& t) { v2x.visit_options(t); });
  s.tables("service", services.size(),
           [this](std::size_t i, option_visitor& t) {
             if (i == services.size())
               services.emplace_back();
             visit_choice(t, services[i], make_service_type, "kind of service",
                          service_type_names());
           });
  s.table("policies", [this](option_visitor& t) { policies.visit_options(t); });
  s.table("record", [this](option_visitor& t) { record.visit_options(t); });
}

const service_type* planning_service(const scenario& s) {
  const auto i = std::ranges::find_if(
      s.services, [](const auto& type) { return type->plans() != nullptr; });
  return i == s.services.end() ? nullptr : i->get();
}

std::string to_toml(scenario what) {
  return print_options([&](option_visitor& s) { what.visit_options(s); });
}

} // namespace sofof
