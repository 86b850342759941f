// From summaries to criteria.
#include "experiments/benchmark/criteria.hpp"

#include "policies/api/periodic_task.hpp"
#include "recording/safety_line.hpp"

#include <algorithm>
#include <utility>

namespace sofof::experiments::bench {

namespace {

constexpr double hour_s = 3600;

} // namespace

/// The figures of a run as far as it tells them.
class summary_figures {
public:
  explicit summary_figures(const study::measured_run& run) : run_{run} {}

  double must(const std::string& name) const { return run_.figure(name); }
  std::optional<double> may(const std::string& name) const {
    const auto found = run_.figures.find(name);
    return found != run_.figures.end() ? std::optional{found->second}
                                       : std::nullopt;
  }

  double driven_hours() const { return must("safety.driven_s") / hour_s; }
  /// @returns how long a provider has run a service, by its place.
  double served_s(provider_id place, const std::string& service) const {
    const auto found = run_.served_s.find({place, service});
    return found != run_.served_s.end() ? found->second : 0;
  }
  double violations() const {
    return must("ended_by.qos_latency") + must("ended_by.qos_input_age")
           + must("ended_by.qos_gap") + may("ended_by.implausible").value_or(0);
  }
  /// @returns the same over all services.
  double all_violations() const {
    return over_services("ended_by.qos_latency")
           + over_services("ended_by.qos_input_age")
           + over_services("ended_by.qos_gap")
           + over_services("ended_by.implausible");
  }
  /// @returns how many cycles of a service were computed in vehicles.
  double cycles_on_board(const std::string& service) const {
    return may("services." + service + ".cycles.on_board").value_or(0);
  }
  /// @returns how many were computed there besides, and not used.
  double cycles_along(const std::string& service) const {
    return may("services." + service + ".warm_standby.cycles").value_or(0);
  }
  /// @returns how many were computed by providers, and used.
  double cycles_offloaded(const std::string& service) const {
    return may("services." + service + ".cycles.offloaded").value_or(0);
  }
  /// @returns the mean latency of its results.
  double latency_s(const std::string& service) const {
    return 1e-3 * may("services." + service + ".latency_ms.mean").value_or(0);
  }
  double energy_saved() const { return may("energy.saved_share").value_or(0); }

  /// @returns the sum of all that stand under services.KIND.NAME….
  double over_services(std::string_view name) const {
    constexpr std::string_view prefix = "services.";
    double sum = 0;
    for (const auto& [path, value] : run_.figures)
      if (path.starts_with(prefix)) {
        const auto kind_end = path.find('.', prefix.size());
        if (path.substr(kind_end + 1).starts_with(name))
          sum += value;
      }
    return sum;
  }

private:
  const study::measured_run& run_;
};

namespace {

constexpr double percent = 100;

// What a cycle costs: λ of time, of energy and of violations.
// Source: as for Chen et al., ToN 24(5) 2016, eqs. (4), (8), with the weights
// of docs/bench.md.
constexpr double of_time = 0.3;
constexpr double of_energy = 0.3;
constexpr double of_violations = 1.0;

/// @returns the share of all workers' time that running services took.
double utilisation(const summary_figures& run, const baseline& by) {
  double busy_s = 0, workers = 0;
  for (std::size_t k = 0; k < by.providers.size(); ++k) {
    const auto& provider = by.providers[k];
    workers += provider.workers;
    for (const auto& [service, share] : provider.utilisation_by)
      busy_s += provider.workers * share * run.served_s(k + 1, service);
  }
  return busy_s / (workers * run.must("virtual_s"));
}

/// @returns how many messages of the protocol there were, as far as a run
/// tells: offers that came, and requests, answers and ends, each counted per
/// service.
double signalling(const summary_figures& run) {
  constexpr double request_and_answer = 2;
  return run.must("offers") + request_and_answer * run.over_services("requests")
         + run.over_services("ended_by.");
}

/// @returns the mean cost of a cycle, of all services; 0 for no cycles.
double score(const summary_figures& run, const baseline& by) {
  double cycles = 0, time = 0; // in parts of the limits
  for (const auto& service : by.services) {
    const auto on_board = run.cycles_on_board(service.name);
    const auto offloaded = run.cycles_offloaded(service.name);
    cycles += on_board + offloaded;
    time +=
        (offloaded * run.latency_s(service.name) + on_board * service.local_s)
        / service.limit_s;
  }
  if (cycles <= 0)
    return 0;
  return of_time * time / cycles + of_energy * (1 - run.energy_saved())
         + of_violations * run.all_violations() / cycles;
}

/// @returns the share of a core that services take on board while a vehicle
/// drives, %; nullopt if none does.
std::optional<double> on_board_percent(const summary_figures& run,
                                       const baseline& by) {
  const auto driven_s = run.driven_hours() * hour_s;
  if (driven_s <= 0)
    return std::nullopt;
  double busy_s = 0;
  for (const auto& service : by.services)
    busy_s +=
        (run.cycles_on_board(service.name) + run.cycles_along(service.name))
        * service.local_s;
  return percent * busy_s / driven_s;
}

/// Adds how much the score of each run is above that of an entrant in the same
/// scenario with the same seed, percent.
void compare(std::vector<judged_run>& runs, std::string_view with,
             std::string_view name) {
  std::map<std::pair<std::string, std::int64_t>, double> scores;
  for (const auto& run : runs)
    if (run.entrant == with)
      scores.emplace(std::pair{run.scenario, run.seed},
                     run.values.at(score_name));
  for (auto& run : runs) {
    const auto found = scores.find({run.scenario, run.seed});
    if (found == scores.end() || found->second <= 0)
      continue;
    run.values.emplace(
        name, percent * (run.values.at(score_name) / found->second - 1));
  }
}

// -- what criteria are made of ------------------------------------------------

using value_of = std::optional<double>;

value_of in_percent(value_of share) {
  return share ? value_of{percent * *share} : share;
}

value_of per_hour(const summary_figures& run, value_of count) {
  const auto hours = run.driven_hours();
  return count && hours > 0 ? value_of{*count / hours} : std::nullopt;
}

/// @returns a part of the energy, per km.
value_of part_per_km(const summary_figures& run, const std::string& part) {
  const auto per_km = run.may("energy.per_km_j");
  const auto all_j = run.may("energy.j");
  const auto part_j = run.may(part);
  if (!per_km || !part_j || !(all_j > 0.0))
    return std::nullopt;
  return *per_km / *all_j * *part_j;
}

constexpr criterion all_criteria[]{
    {"offloaded_percent", "offloaded share, %", "share %", 1, better::more,
     [](const summary_figures& run, const baseline&) {
       return in_percent(run.may("offloaded_share"));
     }},
    {"violations_per_h", "QoS violations, 1/h", "viol/h", 2, better::less,
     [](const summary_figures& run, const baseline&) {
       return per_hour(run, run.violations());
     }},
    {"without_plan_s_per_h", "without a fresh plan, s/h", "", 3, better::less,
     [](const summary_figures& run, const baseline&) {
       return per_hour(run, run.must("safety.without_fresh_plan_s"));
     }},
    {"collisions", "collisions", "", 2, better::less,
     [](const summary_figures& run, const baseline&) {
       return value_of{run.must("safety.collisions")};
     }},
    {"hard_brakes_per_h", "hard brakes, 1/h", "", 2, better::less,
     [](const summary_figures& run, const baseline&) {
       return per_hour(run, run.may("driving.hard_brakes"));
     }},
    {"delay_s", "delay, mean, s", "", 2, better::less,
     [](const summary_figures& run, const baseline&) {
       return run.may("traffic.delay_s.mean");
     }},
    {"delay_p95_s", "delay, 95 %, s", "", 2, better::less,
     [](const summary_figures& run, const baseline&) {
       return run.may("traffic.delay_s.p95");
     }},
    {"stops_per_h", "stops, 1/h", "", 2, better::less,
     [](const summary_figures& run, const baseline&) {
       return per_hour(run, run.may("traffic.stops"));
     }},
    {"fallbacks_per_h", "fallbacks, 1/h", "fallb/h", 2, better::less,
     [](const summary_figures& run, const baseline&) {
       return per_hour(run, run.must("fallbacks"));
     }},
    {"ping_pongs_per_h", "ping-pongs, 1/h", "", 2, better::less,
     [](const summary_figures& run, const baseline&) {
       return per_hour(run, run.must("ping_pongs"));
     }},
    {"hand_overs_per_h", "hand-overs, 1/h", "", 2, better::neither,
     [](const summary_figures& run, const baseline&) {
       return per_hour(run, run.must("hand_overs"));
     }},
    {"latency_mean_ms", "latency, mean, ms", "", 2, better::less,
     [](const summary_figures& run, const baseline&) {
       return run.may("latency_ms.mean");
     }},
    {"latency_p50_ms", "latency, median, ms", "", 2, better::less,
     [](const summary_figures& run, const baseline&) {
       return run.may("latency_ms.p50");
     }},
    {"latency_p95_ms", "latency, 95 %, ms", "", 2, better::less,
     [](const summary_figures& run, const baseline&) {
       return run.may("latency_ms.p95");
     }},
    {"latency_p99_ms", "latency, 99 %, ms", "p99 ms", 2, better::less,
     [](const summary_figures& run, const baseline&) {
       return run.may("latency_ms.p99");
     }},
    {"vehicle_cpu_percent", "computing on board, % of a core", "", 2,
     better::less,
     [](const summary_figures& run, const baseline& by) {
       return on_board_percent(run, by);
     }},
    {"energy_j_per_km", "energy in vehicles, J/km", "", 1, better::less,
     [](const summary_figures& run, const baseline&) {
       return run.may("energy.per_km_j");
     }},
    {"energy_on_board_j_per_km", "energy of computing on board, J/km", "", 1,
     better::less,
     [](const summary_figures& run, const baseline&) {
       return part_per_km(run, "energy.local_j");
     }},
    {"energy_offloading_j_per_km", "energy of offloading, J/km", "", 1,
     better::less,
     [](const summary_figures& run, const baseline&) {
       return part_per_km(run, "energy.offloading_j");
     }},
    {"energy_server_j_per_km", "energy at providers, J/km", "", 1, better::less,
     [](const summary_figures& run, const baseline&) {
       return part_per_km(run, "energy.server_j");
     }},
    {"energy_saved_percent", "energy saved, %", "saved %", 1, better::more,
     [](const summary_figures& run, const baseline&) {
       return in_percent(run.may("energy.saved_share"));
     }},
    {"utilisation_percent", "utilisation of providers, %", "", 1,
     better::neither,
     [](const summary_figures& run, const baseline& by) {
       if (by.providers.empty())
         return value_of{};
       return in_percent(utilisation(run, by));
     }},
    {"rejected_percent", "rejected, %", "", 1, better::neither,
     [](const summary_figures& run, const baseline&) {
       const auto requests = run.must("requests");
       if (requests <= 0)
         return value_of{};
       return in_percent(run.must("rejected") / requests);
     }},
    {"fairness", "fairness (Jain)", "Jain", 3, better::more,
     [](const summary_figures& run, const baseline&) {
       return run.may("fairness");
     }},
    {"messages_per_s", "signalling, messages/s", "", 2, better::less,
     [](const summary_figures& run, const baseline&) {
       return value_of{signalling(run) / run.must("virtual_s")};
     }},
    {regret_name, "regret, %", "regret %", 1, better::less, nullptr, "oracle"},
    {than_location_name, "than location, %", "", 1, better::less, nullptr,
     "location"},
    {score_name, "score", "score", 4, better::less,
     [](const summary_figures& run, const baseline& by) {
       return value_of{score(run, by)};
     }},
};

provider_capacity capacity_of(const scenario::scenario_definition& s,
                              const channel::provider_compute& compute) {
  const auto workers = static_cast<std::size_t>(compute.workers);
  provider_capacity capacity{static_cast<double>(workers), {}};
  for (const auto& type : s.services)
    capacity.utilisation_by.emplace(
        type->name(),
        policies::worker_share(compute.mean_s()
                                   * world::demand_of(type->options.compute),
                               type->options.period, workers));
  return capacity;
}

} // namespace

std::span<const criterion> criteria() {
  return all_criteria;
}

baseline baseline_of(const scenario::scenario_definition& s) {
  baseline by;
  for (std::size_t k = 0; k < s.providers.size(); ++k)
    by.providers.push_back(capacity_of(s, s.compute_of(k)));
  for (const auto& type : s.services) {
    const auto& options = type->options;
    by.services.push_back({std::string{type->name()},
                           to_seconds(options.limits.max_latency),
                           to_seconds(options.period),
                           to_seconds(options.compute.run_time_mean)});
  }
  return by;
}

judged_run judge(const study::measured_run& measured, const baseline& by) {
  const summary_figures run{measured};
  judged_run judged;
  judged.seed = measured.point.seed;
  if (!measured.point.labels.empty())
    judged.entrant = measured.point.labels.front();
  for (const auto& one : criteria())
    if (const auto value = one.of ? one.of(run, by) : std::nullopt)
      judged.values.emplace(one.name, *value);
  judged.safe = recording::is_safe(
      [&run](const std::string& name) { return run.must(name); });
  return judged;
}

void compare_scores(std::vector<judged_run>& runs) {
  for (const auto& one : criteria())
    if (!one.with.empty())
      compare(runs, one.with, one.name);
}

} // namespace sofof::experiments::bench
