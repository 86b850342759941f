// One experiment: everything that a scenario file can say, with defaults.
#include "scenario/scenario.hpp"

#include "base/options/option_helpers.hpp"
#include "base/options/option_printer.hpp"
#include "base/protocol.hpp"
#include "policies/registry.hpp"
#include "recording/cpu_balance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace sofof::scenario {

using namespace std::chrono_literals;

namespace {

double to_rad(double angle_deg) {
  return angle_deg * std::numbers::pi / 180;
}

/// @returns where a name belongs that is no policy of the side where it stands;
/// nothing for one that nobody has.
std::string right_place(std::string_view name) {
  if (policies::make_lodm(name))
    return fmt::format("It is an LODM: lodm = \"{}\".", name);
  if (policies::make_codm(name))
    return fmt::format("It is a CODM: codm = \"{}\".", name);
  if (policies::make_governor(name))
    return fmt::format(
        "It is a governor: lodm = {{ name = \"location\", govern = "
        "[{{ name = \"{}\" }}] }}.",
        name);
  return {};
}

/// Lists the name of a channel profile; hyphens were once in some.
void visit_profile(option_visitor& s, std::string_view key, std::string& name) {
  const auto known = channel::channel_profile_names();
  s.field(key, name);
  auto now = name;
  std::ranges::replace(now, '-', '_');
  if (now != name && std::ranges::find(known, now) != known.end()) {
    s.note(key, fmt::format("\"{}\" is \"{}\" now; the old name still counts.",
                            name, now));
    name = now;
  }
  if (std::ranges::find(known, name) == known.end())
    s.refuse(key, unknown_word("channel profile", name, known));
}

bool may_be_service(std::string_view name) {
  return !name.empty() && name.size() <= messages::service_name::max_size
         && std::ranges::all_of(name, [](char c) {
              return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')
                     || c == '_';
            });
}

/// Lists a service by its name; one with a `command` is a program.
void visit_service(option_visitor& s, actors::service_type_ptr& service) {
  constexpr std::string_view program = "program";
  if (!s.has("command", service && service->is_program())) {
    if (service && service->is_program())
      service = nullptr;
    return visit_choice(s, service, actors::make_service_type,
                        "kind of service", actors::service_type_names());
  }
  if (!service || !service->is_program())
    service = actors::make_service_type(program);
  std::string name{service->name()};
  s.field("name", name);
  if (name != program && actors::make_service_type(name))
    return s.refuse("name",
                    fmt::format("is a function of SOFOF's own; name the "
                                "program \"my_{}\", or leave out `command`.",
                                name));
  if (!may_be_service(name))
    return s.refuse("name",
                    "must have 1 to 31 of the characters a-z, 0-9 and _.");
  service->be_called(name);
  service->visit_options(s);
}

} // namespace

oriented_box obstacle_options::box() const {
  return {position_m, to_rad(heading_deg), length_m, width_m};
}

world::scripted_body obstacle_options::script(station_id id) const {
  std::vector<world::scripted_body::moment> all;
  for (const auto& m : moments)
    all.push_back({m.t_s, m.position_m, to_rad(m.heading_deg), m.speed_mps});
  return {id, length_m, width_m, std::move(all)};
}

world::sensor roadside_options::make(random_stream noise) const {
  return {can, noise, position_m, to_rad(heading_deg), std::nullopt};
}

polygon provider_options::area() const {
  return area_m.empty() ? area_round(position_m) : polygon{area_m};
}

polygon provider_options::area_round(point centre) const {
  return polygon::regular(centre, area_radius_m,
                          static_cast<unsigned>(area_corners));
}

double provider_options::reach_m() const {
  return area_radius_m
         * std::cos(std::numbers::pi / static_cast<double>(area_corners));
}

provider_options ride_options::in_vehicle(station_id carrier,
                                          std::size_t fleet) const {
  provider_options made;
  made.name = is_in_all() ? fmt::format("{}_{}", name, carrier) : name;
  made.area_radius_m = area_radius_m;
  made.area_corners = area_corners;
  made.range_m = range_m;
  made.services = services;
  made.radio = radio;
  made.network = network;
  made.compute = compute;
  made.carrier = {carrier, fleet};
  return made;
}

void visit_services(option_visitor& s, std::vector<std::string>& services) {
  if (!s.has("services", !services.empty()))
    return;
  s.field("services", services);
  if (services.empty())
    s.refuse("services", "must name at least one service; leave it out to "
                         "offer all.");
}

void visit_own_network(option_visitor& s,
                       std::optional<network_options>& network) {
  if (!s.has("network", network.has_value()))
    return;
  s.table("network", [&network](option_visitor& t) {
    if (!network)
      network.emplace();
    network->visit_options(t);
    if (network->profile.replays
        && (network->profile.trace.empty() || !network->trace.empty()))
      t.refuse("profile", "replays a file, which only [network] can.");
  });
}

void visit_own_compute(option_visitor& s,
                       std::optional<compute_options>& compute) {
  if (!s.has("compute", compute.has_value()))
    return;
  s.table("compute", [&compute](option_visitor& t) {
    if (!compute)
      compute.emplace();
    compute->visit_options(t);
  });
}

std::vector<provider_options> provider_grid_options::all() const {
  std::vector<provider_options> placed;
  for (std::int64_t row = 0; row < rows; ++row)
    for (std::int64_t column = 0; column < columns; ++column) {
      auto& p = placed.emplace_back();
      p.name = fmt::format("mec_{}_{}", row, column);
      p.position_m =
          first_m
          + apart_m
                * point{static_cast<double>(column), static_cast<double>(row)};
      p.area_radius_m = area_radius_m;
      p.range_m = range_m;
    }
  return placed;
}

bool provider_options::offers(std::string_view service) const {
  return services.empty()
         || std::ranges::find(services, service) != services.end();
}

void network_options::visit_options(option_visitor& s) {
  auto name = profile.name;
  visit_profile(s, "profile", name);
  if (name != profile.name)
    profile = channel::find_channel_profile(name).value_or(profile);
  if (s.has("trace", !trace.empty())) {
    s.field("trace", trace);
    if (!profile.replays)
      s.refuse("trace", "has no effect with this profile; use \"trace\".");
    if (trace.empty())
      s.refuse("trace", "must name a file.");
  } else if (profile.replays && profile.trace.empty()) {
    s.refuse("profile", "needs a file to replay: add trace = \"FILE\".");
  }
  profile.visit_options(s);
  if (!s.has("transport", transport != "direct"))
    return;
  s.field("transport", transport);
  constexpr std::string_view known[] = {"direct", "amqp"};
  if (std::ranges::count(known, transport) == 0)
    s.refuse("transport", unknown_word("transport", transport, known));
}

void compute_options::visit_options(option_visitor& s) {
  if (s.has("model", model.has_value()))
    visit_profile(s, "model", model ? *model : model.emplace());
  if (s.has("workers", workers.has_value()))
    s.field("workers", workers ? *workers : workers.emplace(1),
            {1, channel::most_workers});
  if (s.has("more_computing", more_computing.has_value()))
    s.field("more_computing",
            more_computing ? *more_computing : more_computing.emplace(), 0ns);
  if (s.has("worker_w", worker_w.has_value()))
    s.field("worker_w", worker_w ? *worker_w : worker_w.emplace(), {0, 1e4});
  if (s.has("worker_idle_w", worker_idle_w.has_value()))
    s.field("worker_idle_w",
            worker_idle_w ? *worker_idle_w : worker_idle_w.emplace(), {0, 1e4});
}

compute_options compute_options::for_own_network() const {
  auto own = *this;
  if (of_network.workers)
    own.workers.reset();
  if (of_network.more_computing)
    own.more_computing.reset();
  return own;
}

void compute_options::complete(const std::string& profile) {
  const auto measured = channel::compute_measured_with(model.value_or(profile));
  model = measured.model;
  workers = workers.value_or(measured.workers);
  more_computing = more_computing.value_or(measured.more_computing);
  worker_w = worker_w.value_or(recording::core_power{}.more_when_busy_w());
  worker_idle_w = worker_idle_w.value_or(recording::core_power{}.idle_w);
}

channel::provider_compute compute_options::computers() const {
  auto all = channel::compute_measured_with(model.value());
  all.workers = workers.value();
  all.more_computing = more_computing.value();
  all.worker_w = worker_w.value();
  all.worker_idle_w = worker_idle_w.value();
  return all;
}

policy_options::policy_options()
    : lodm{policies::make_lodm("location")}, codm{policies::make_codm(
                                                 "location")} {}

void policy_options::visit_options(option_visitor& s) {
  s.table("lodm", [this](option_visitor& t) {
    visit_choice(t, lodm, policies::make_lodm, "LODM policy",
                 policies::lodm_names(), right_place);
  });
  s.table("codm", [this](option_visitor& t) {
    visit_choice(t, codm, policies::make_codm, "CODM policy",
                 policies::codm_names(), right_place);
  });
  if (s.has("forecast", forecast.source != "none"))
    s.table("forecast",
            [this](option_visitor& t) { forecast.visit_options(t); });
}

std::int64_t scenario_definition::vehicles() const {
  std::int64_t all = 0;
  for (const auto& fleet : fleets)
    all += fleet.count;
  return all;
}

const std::shared_ptr<const channel::channel_profile>&
scenario_definition::channel_to(std::size_t place) const {
  assert(place < providers.size());
  const auto& own = providers[place].network;
  return own ? own->channel : network.channel;
}

channel::provider_compute
scenario_definition::compute_of(std::size_t place) const {
  assert(place < providers.size());
  const auto& own = providers[place].compute;
  return (own ? *own : compute).computers();
}

std::string scenario_definition::key_of(std::size_t place) const {
  assert(place < providers.size());
  const auto& carrier = providers[place].carrier;
  return carrier ? fmt::format("fleet.{}.provide", carrier->fleet)
                 : fmt::format("provider.{}", place);
}

std::string scenario_definition::profiles() const {
  std::vector<std::string_view> names;
  for (const auto& p : providers) {
    const std::string_view name =
        (p.network ? *p.network : network).profile.name;
    if (std::ranges::find(names, name) == names.end())
      names.push_back(name);
  }
  return names.empty() ? network.profile.name
                       : fmt::format("{}", fmt::join(names, ", "));
}

void scenario_definition::visit_options(option_visitor& s) {
  s.field("name", name);
  if (name.empty())
    s.refuse("name", "must not be empty.");
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
  if (s.has("provider_grid", provider_grid.has_value()))
    s.table("provider_grid", [this](option_visitor& t) {
      if (!provider_grid)
        provider_grid.emplace();
      provider_grid->visit_options(t);
    });
  if (s.moved("network.workers", "compute.workers"))
    compute.of_network.workers = true;
  if (s.moved("network.more_computing", "compute.more_computing"))
    compute.of_network.more_computing = true;
  s.table("network", [this](option_visitor& t) { network.visit_options(t); });
  s.table("compute", [this](option_visitor& t) { compute.visit_options(t); });
  if (s.has("vehicle_host", vehicle_host.cores > 0))
    s.table("vehicle_host", [this](option_visitor& t) {
      vehicle_host.visit_options(t);
      if (!vehicle_host.carries(vehicles()))
        t.refuse("busy_cores",
                 fmt::format("asks for all {} cores or more, with {} vehicles.",
                             vehicle_host.cores, vehicles()));
    });
  s.table("v2x", [this](option_visitor& t) { v2x.visit_options(t); });
  s.tables("service", services.size(),
           [this](std::size_t i, option_visitor& t) {
             if (i == services.size())
               services.emplace_back();
             visit_service(t, services[i]);
           });
  s.table("policies", [this](option_visitor& t) { policies.visit_options(t); });
  s.table("record", [this](option_visitor& t) { record.visit_options(t); });
}

const actors::service_type* planning_service(const scenario_definition& s) {
  const auto i = std::ranges::find_if(
      s.services, [](const auto& type) { return type->plans() != nullptr; });
  return i == s.services.end() ? nullptr : i->get();
}

const actors::service_type* find_service(const scenario_definition& s,
                                         std::string_view name) {
  const auto i = std::ranges::find_if(
      s.services, [&](const auto& type) { return type->name() == name; });
  return i == s.services.end() ? nullptr : i->get();
}

std::uint32_t place_in_chain(const scenario_definition& s,
                             const actors::service_type& type) {
  const auto* before = find_service(s, type.follows());
  return before ? place_in_chain(s, *before) + 1 : 0;
}

std::vector<std::string> chain_of(const scenario_definition& s) {
  std::vector<std::string> names;
  const auto* type = planning_service(s);
  for (; type; type = find_service(s, type->follows()))
    names.emplace(names.begin(), type->name());
  return names;
}

std::string to_toml(scenario_definition what) {
  // What rides is said by the fleet that it rides with.
  std::erase_if(what.providers,
                [](const auto& p) { return p.carrier.has_value(); });
  return print_options([&](option_visitor& s) { what.visit_options(s); });
}

} // namespace sofof::scenario
