// What services took out of batteries, and at providers.
#include "recording/figures.hpp"

#include <functional>

namespace sofof::recording {

namespace {

constexpr int places_of_energy = 6;
constexpr int places_of_nj = 9;
constexpr int places_of_share_saved = 6;
constexpr double percent_of_share = 100;

std::optional<double> if_costed(const energy_figures& x, double value) {
  return x.all_on_board_j > 0 ? std::optional{value} : std::nullopt;
}

// What the service took in the vehicles.
energy_figures energy_of(const service_in_run& x) {
  return x.all.work().energy(x.of.service);
}

std::optional<double> at_servers(const service_in_run& x) {
  return server_energy_j(x.all.load(), from_seconds(x.end.virtual_s),
                         x.of.service.view());
}

std::optional<double> at_servers(const whole_run& x) {
  std::optional<double> sum_j;
  for (const auto& service : x.of.services())
    if (const auto one_j = at_servers({service, x.of, x.run, x.end}))
      sum_j = sum_j.value_or(0) + *one_j;
  return sum_j;
}

std::optional<double> energy_per_km(const whole_run& x) {
  constexpr auto m_per_km = 1e3;
  const auto distance_m = x.of.together().ride.distance_m;
  if (distance_m <= 0)
    return std::nullopt;
  const auto energy = x.of.work().energy();
  return if_costed(energy, energy.j() * m_per_km / distance_m);
}

std::optional<double> if_known(const whole_run& x, double value) {
  return x.of.energy().vehicles > 0 ? std::optional{value} : std::nullopt;
}

/// A part of the energy of both ends, or a sum of some.
template <auto Part>
std::optional<double> total_of(const whole_run& x) {
  return if_known(x, joules(std::invoke(Part, x.of.energy().all.spent)));
}
template <auto Part>
constexpr auto total = [](const auto& x) { return total_of<Part>(x); };

/// By all splits of services that work on each other's results.
std::optional<double> saved_by_chain(const whole_run& x) {
  std::optional<double> saved_j;
  for (const auto& [which, sum] : x.of.energy().splits)
    if (which.second.size() > 1)
      saved_j = saved_j.value_or(0) + joules(sum.saved_nj());
  return saved_j;
}

constexpr service_figure of_service_cost[]{
    {"cycles.on_board", 0,
     [](const auto& x) { return x.all.work().cycles(x.of.service).on_board; }},
    {"cycles.offloaded", 0,
     [](const auto& x) { return x.all.work().cycles(x.of.service).offloaded; }},
    {"energy.local_j",
     places_of_energy,
     [](const auto& x) {
       return if_costed(energy_of(x), energy_of(x).on_board_j);
     },
     {report_table::service, 220, "energy on board, J", 1}},
    {"energy.offloading_j",
     places_of_energy,
     [](const auto& x) {
       return if_costed(energy_of(x), energy_of(x).offloading_j);
     },
     {report_table::service, 222, "energy of sending, J", 3}},
    {"energy.all_on_board_j", places_of_energy,
     [](const auto& x) {
       return if_costed(energy_of(x), energy_of(x).all_on_board_j);
     }},
    {"energy.saved_share",
     places_of_share_saved,
     [](const auto& x) { return energy_of(x).saved_share(); },
     {report_table::service, 224, "energy saved, %", 1, percent_of_share}},
    {"energy.server_j",
     places_of_energy,
     [](const auto& x) { return at_servers(x); },
     {report_table::service, 226, "energy at providers, J", 1}},
};

constexpr run_figure of_run_cost[]{
    {"energy.j",
     places_of_energy,
     [](const auto& x) {
       return if_costed(x.of.work().energy(), x.of.work().energy().j());
     },
     {},
     {console_block::energy, 10, "in the vehicles", 1, "J"}},
    {"energy.local_j", places_of_energy,
     [](const auto& x) {
       return if_costed(x.of.work().energy(), x.of.work().energy().on_board_j);
     }},
    {"energy.offloading_j",
     places_of_energy,
     [](const auto& x) {
       return if_costed(x.of.work().energy(),
                        x.of.work().energy().offloading_j);
     },
     {},
     {console_block::energy, 15, "  of it by offloading", 3, "J"}},
    {"energy.all_on_board_j", places_of_energy,
     [](const auto& x) {
       return if_costed(x.of.work().energy(),
                        x.of.work().energy().all_on_board_j);
     }},
    {"energy.per_km_j",
     places_of_energy,
     [](const auto& x) { return energy_per_km(x); },
     {report_table::safety, 140, "energy of the services in vehicles, J/km", 1},
     {console_block::energy, 20, "per km", 1, "J"}},
    {"energy.saved_share",
     places_of_share_saved,
     [](const auto& x) { return x.of.work().energy().saved_share(); },
     {report_table::safety, 150, "energy saved by offloading, %", 1,
      percent_of_share},
     {console_block::energy, 30, "saved by offloading", 1, "%",
      percent_of_share}},
    {"energy.server_j",
     places_of_energy,
     [](const auto& x) { return at_servers(x); },
     {report_table::safety, 155, "energy of the services at providers, J", 1},
     {console_block::energy, 40, "at the providers", 1, "J"}},
    {"energy.both_ends.j", places_of_nj, total<&exact_energy::nj>},
    {"energy.both_ends.vehicle_j", places_of_nj,
     total<&exact_energy::vehicle_nj>},
    {"energy.both_ends.radio_j", places_of_nj, total<&exact_energy::radio_nj>},
    {"energy.both_ends.server_j", places_of_nj,
     total<&exact_energy::server_nj>},
    {"energy.both_ends.computing_j", places_of_nj,
     total<&exact_energy::computing_nj>},
    {"energy.both_ends.resting_j", places_of_nj,
     total<&exact_energy::resting_nj>},
    {"energy.both_ends.framework_j", places_of_nj,
     total<&exact_energy::framework_nj>},
    {"energy.both_ends.sending_j", places_of_nj,
     total<&exact_energy::sending_nj>},
    {"energy.both_ends.receiving_j", places_of_nj,
     total<&exact_energy::receiving_nj>},
    {"energy.both_ends.server_busy_j", places_of_nj,
     total<&exact_energy::server_busy_nj>},
    {"energy.both_ends.server_idle_j", places_of_nj,
     total<&exact_energy::server_idle_nj>},
    {"energy.both_ends.server_unused_j", places_of_energy,
     [](const auto& x) { return if_known(x, x.of.energy().unused_server_j); }},
    {"energy.both_ends.home_j", places_of_nj,
     [](const auto& x) {
       return if_known(x, joules(x.of.energy().all.home_nj));
     }},
    {"energy.both_ends.saved_j", places_of_nj,
     [](const auto& x) {
       return if_known(x, joules(x.of.energy().all.saved_nj()));
     }},
    {"energy.both_ends.saved_per_drive_j", places_of_energy,
     [](const auto& x) {
       return if_known(x, joules(x.of.energy().all.saved_nj())
                              / static_cast<double>(x.of.energy().vehicles));
     }},
    {"energy.both_ends.saved_per_km_j",
     places_of_energy,
     [](const auto& x) {
       return x.of.energy().vehicles > 0 ? x.of.energy().all.saved_j_per_km()
                                         : std::nullopt;
     },
     {report_table::safety, 156, "energy saved at both ends, J/km", 1}},
    {"energy.both_ends.break_even_w",
     places_of_energy,
     [](const auto& x) { return x.of.energy().all.break_even_w(); },
     {report_table::safety, 157,
      "power of vehicles' computers from which that pays, W", 2}},
    {"energy.both_ends.chain_saved_j",
     places_of_nj,
     [](const auto& x) { return saved_by_chain(x); },
     {},
     {console_block::energy, 50, "saved at both ends", 1, "J"}},
};

} // namespace

std::span<const service_figure> service_cost_figures() {
  return of_service_cost;
}

std::span<const run_figure> run_cost_figures() {
  return of_run_cost;
}

} // namespace sofof::recording
