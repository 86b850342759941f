// All functions of a vehicle at home at once.
#include "scenario/vehicle_schedule.hpp"

#include "policies/algorithms/scheduling/preemptive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace sofof::scenario {

namespace {

/// @returns the functions of the scenario's services on such a computer.
std::vector<policies::periodic_task>
tasks_on(const world::computer_options& computer,
         const scenario_definition& all) {
  std::vector<policies::periodic_task> tasks;
  for (const auto& type : all.services) {
    const auto options = offloading::on(computer, type->options);
    const auto period = options.period;
    tasks.push_back(
        {.wcet = world::longest_run_time(options.compute),
         .period = period,
         .deadline = period,
         .jitter = options.per_input
                       ? policies::jitter_of_calls(period)
                       : policies::jitter_with_first_cycle(period)});
  }
  return tasks;
}

/// Fills in what one core has to do.
void add_core(vehicle_schedule& made, std::size_t core,
              std::span<const policies::periodic_task> tasks) {
  std::vector<policies::periodic_task> here;
  for (std::size_t k = 0; k < tasks.size(); ++k)
    if (auto& one = made.functions[k]; one.core == core) {
      one.number = here.size();
      here.push_back(tasks[k]);
    }
  const auto responses = policies::preemptive_responses(here, made.order);
  for (auto& one : made.functions)
    if (one.core == core)
      one.at_most = responses[one.number];
  made.loads.push_back(policies::utilisation(here));
}

std::string in_ms(duration d) {
  return fmt::format("{:.1f} ms", to_milliseconds(d));
}

std::string stated(const function_response& of) {
  return of.at_most ? in_ms(*of.at_most) + " at most" : "no bound";
}

std::string vehicles_of(const vehicle_schedule& schedule) {
  const auto first = schedule.first_station;
  return schedule.vehicles == 1 ? fmt::format("vehicle {}", first)
                                : fmt::format("vehicles {} to {}", first,
                                              first + schedule.vehicles - 1);
}

} // namespace

std::optional<vehicle_schedule> schedule_at_home(const scenario_definition& all,
                                                 std::size_t fleet) {
  const auto& options = all.fleets.at(fleet);
  if (!options.compute.scheduling)
    return std::nullopt;
  const auto tasks = tasks_on(options.compute, all);
  const auto cores = static_cast<std::size_t>(options.compute.cores);
  vehicle_schedule made{.first_station = options.first_station,
                        .vehicles = options.count,
                        .order = *options.compute.scheduling,
                        .loads = {},
                        .functions = {}};
  const auto core_of = policies::share_out(tasks, cores);
  for (std::size_t k = 0; k < tasks.size(); ++k)
    made.functions.push_back({.service = std::string{all.services[k]->name()},
                              .core = core_of[k],
                              .limit = tasks[k].deadline,
                              .at_most = {}});
  for (std::size_t core = 0; core < cores; ++core)
    add_core(made, core, tasks);
  return made;
}

std::vector<channel::core_seat> seats_of(const vehicle_schedule& schedule) {
  std::vector<std::shared_ptr<channel::preemptive_core>> cores;
  for (std::size_t core = 0; core < schedule.loads.size(); ++core)
    cores.push_back(std::make_shared<channel::preemptive_core>(
        schedule.order,
        static_cast<std::size_t>(std::ranges::count(
            schedule.functions, core, &function_response::core))));
  std::vector<channel::core_seat> seats;
  for (const auto& one : schedule.functions)
    seats.push_back({cores[one.core], one.number});
  return seats;
}

std::string to_comment(const vehicle_schedule& schedule) {
  const auto cores = schedule.loads.size();
  std::string loads;
  for (const auto load : schedule.loads)
    loads += fmt::format("{}{:.0f} %", loads.empty() ? "" : ", ", 100 * load);
  auto text = fmt::format(
      "# All functions of {} at home, by {} on {} core{}; load {}.\n",
      vehicles_of(schedule),
      schedule.order == core_order::edf ? "deadlines" : "fixed priorities",
      cores, cores == 1 ? "" : "s", loads);
  for (const auto& one : schedule.functions)
    text += fmt::format("#   {}{}: {}; limit {}.\n", one.service,
                        cores == 1 ? "" : fmt::format(" (core {})", one.core),
                        stated(one), in_ms(one.limit));
  return text;
}

std::string warning_of(const vehicle_schedule& schedule) {
  const auto late = std::ranges::find_if_not(schedule.functions,
                                             &function_response::is_in_time);
  if (late == schedule.functions.end())
    return {};
  return fmt::format(
      "{} may be too slow to take all functions back: with all at home a "
      "result of \"{}\" {} {}, where {} are allowed; more cores, a faster "
      "clock or another order of services may do.",
      vehicles_of(schedule), late->service, late->at_most ? "takes" : "has",
      stated(*late), in_ms(late->limit));
}

} // namespace sofof::scenario
