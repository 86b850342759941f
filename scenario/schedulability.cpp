// All vehicles at once, each with all that a provider offers.
#include "scenario/schedulability.hpp"

#include "world/vehicle/cycle_cost.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sofof::scenario {

namespace {

using policies::session_group;

/// @returns a session of each service that a provider offers.
std::vector<session_group> mix_of(const scenario_definition& all,
                                  std::size_t place) {
  const auto one = all.compute_of(place).bound();
  std::vector<session_group> mix;
  for (const auto& type : all.services) {
    if (!all.providers[place].offers(type->name()))
      continue;
    const auto& options = type->options;
    const auto demand = world::demand_of(options.compute);
    mix.push_back({{.wcet = from_seconds(one.at_most_s * demand),
                    .period = options.period,
                    .deadline = options.limits.max_latency,
                    .overrun = {one.probability, one.beyond_s * demand}}});
    if (options.per_input)
      mix.back().task.jitter = policies::jitter_of_calls(options.period);
  }
  return mix;
}

/// @returns how many vehicles a provider may have to serve: nobody serves
/// itself.
std::int64_t connected_vehicles(const scenario_definition& all,
                                std::size_t place) {
  std::int64_t count = 0;
  for (const auto& fleet : all.fleets)
    if (fleet.connected)
      count += fleet.count;
  const auto rides = all.providers[place].carrier.has_value();
  return rides ? std::max<std::int64_t>(count - 1, 1) : count;
}

auto responses(std::vector<session_group> mix, std::int64_t vehicles,
               std::int64_t workers, bool beginning) {
  for (auto& [task, count] : mix) {
    count = static_cast<std::size_t>(vehicles);
    if (beginning)
      task.jitter =
          std::max(task.jitter, policies::jitter_with_first_cycle(task.period));
  }
  return policies::stated_responses(mix, static_cast<std::size_t>(workers));
}

bool all_in_time(const std::vector<session_group>& mix, std::int64_t vehicles,
                 std::int64_t workers) {
  const auto all = responses(mix, vehicles, workers, true);
  if (!all)
    return false;
  for (std::size_t i = 0; i < mix.size(); ++i)
    if ((*all)[i].at_most > mix[i].task.deadline || (*all)[i].later > most_late)
      return false;
  return true;
}

/// @returns with how many workers at least all are in time.
std::optional<std::int64_t> workers_for(const std::vector<session_group>& mix,
                                        std::int64_t vehicles) {
  std::int64_t few = 0, enough = channel::most_workers;
  if (!all_in_time(mix, vehicles, enough))
    return std::nullopt;
  while (enough - few > 1) {
    const auto middle = (few + enough) / 2;
    (all_in_time(mix, vehicles, middle) ? enough : few) = middle;
  }
  return enough;
}

std::string workers_of(std::int64_t count) {
  return fmt::format("{} worker{}", count, count == 1 ? "" : "s");
}

std::string milliseconds(duration d) {
  return fmt::format("{:.1f} ms", to_milliseconds(d));
}

std::string stated(const std::optional<policies::response_quantile>& of) {
  if (!of)
    return "no bound";
  return of->later > 0 ? fmt::format("{} for all but {:.2g} % of results",
                                     milliseconds(of->at_most), 100 * of->later)
                       : fmt::format("{} at most", milliseconds(of->at_most));
}

} // namespace

bool service_response::is_in_time() const {
  return beginning && beginning->at_most <= limit
         && beginning->later <= most_late;
}

provider_schedule schedule_of(const scenario_definition& all,
                              std::size_t place) {
  const auto mix = mix_of(all, place);
  provider_schedule made;
  made.provider = all.providers[place].name;
  made.workers = all.compute_of(place).workers;
  made.vehicles = connected_vehicles(all, place);
  const auto beginning = responses(mix, made.vehicles, made.workers, true);
  const auto running = responses(mix, made.vehicles, made.workers, false);
  std::size_t i = 0;
  for (const auto& type : all.services) {
    if (!all.providers[place].offers(type->name()))
      continue;
    const auto& task = mix[i].task;
    made.load +=
        static_cast<double>(made.vehicles)
        * policies::worker_share(to_seconds(task.wcet), task.period,
                                 static_cast<std::size_t>(made.workers));
    service_response one{std::string{type->name()}, task.deadline, {}, {}};
    if (beginning)
      one.beginning = (*beginning)[i];
    if (running)
      one.running = (*running)[i];
    made.services.push_back(one);
    ++i;
  }
  // With more vehicles nothing becomes faster: the last one that is in time.
  std::int64_t most = made.vehicles + 1;
  while (most - made.in_time_with > 1) {
    const auto middle = (made.in_time_with + most) / 2;
    (all_in_time(mix, middle, made.workers) ? made.in_time_with : most) =
        middle;
  }
  made.workers_needed = workers_for(mix, made.vehicles);
  return made;
}

bool provider_schedule::is_like(const provider_schedule& other) const {
  auto renamed = other;
  renamed.provider = provider;
  renamed.alike = alike;
  return in_time_with == other.in_time_with
         && to_comment(renamed) == to_comment(*this);
}

std::string to_comment(const provider_schedule& schedule) {
  auto text = fmt::format(
      "# Provider \"{}\"{} ({}), vehicles at once: {}; load {:.0f} %; all in "
      "time with {}.\n",
      schedule.provider,
      schedule.alike > 0 ? fmt::format(" and {} like it", schedule.alike) : "",
      workers_of(schedule.workers), schedule.vehicles, 100 * schedule.load,
      schedule.workers_needed ? workers_of(*schedule.workers_needed)
                              : "no number of workers");
  for (const auto& one : schedule.services) {
    const auto later =
        one.running ? fmt::format(", {} once all run", stated(one.running))
                    : "";
    text += fmt::format("#   {}: {}{}; limit {} with the way.\n", one.service,
                        stated(one.beginning), later, milliseconds(one.limit));
  }
  return text;
}

std::string warning_of(const provider_schedule& schedule,
                       const scenario_definition& all) {
  const auto late = std::ranges::find_if_not(schedule.services,
                                             &service_response::is_in_time);
  if (late == schedule.services.end()
      || all.policies.codm->name() == "response_time")
    return {};
  return fmt::format(
      "provider \"{}\"{} may be too slow, with {} vehicles at once: a response "
      "of "
      "\"{}\" {} {}, where {} are allowed; with up to {} all are in time{}.",
      schedule.provider,
      schedule.alike > 0 ? fmt::format(", like {} more,", schedule.alike) : "",
      schedule.vehicles, late->service, late->beginning ? "takes" : "has",
      stated(late->beginning), milliseconds(late->limit), schedule.in_time_with,
      schedule.workers_needed
          ? ", or with " + workers_of(*schedule.workers_needed)
          : "");
}

} // namespace sofof::scenario
