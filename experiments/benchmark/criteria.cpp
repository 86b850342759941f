// From summaries to criteria.
#include "experiments/benchmark/criteria.hpp"

#include <algorithm>
#include <utility>

namespace sofof::bench {

namespace {

constexpr double hour_s = 3600;
constexpr double percent = 100;

// What a planning cycle costs: λ of time, of energy and of violations.
// Source: as for Chen et al., ToN 24(5) 2016, eqs. (4), (8), with the weights
// of docs/bench.md.
constexpr double of_time = 0.3;
constexpr double of_energy = 0.3;
constexpr double of_violations = 1.0;

constexpr criterion all_criteria[]{
    {"offloaded_percent", "offloaded share, %", "share %", 1, better::more},
    {"violations_per_h", "QoS violations, 1/h", "viol/h", 2, better::less},
    {"without_plan_s_per_h", "without a fresh plan, s/h", "", 3, better::less},
    {"collisions", "collisions", "", 2, better::less},
    {"fallbacks_per_h", "fallbacks, 1/h", "fallb/h", 2, better::less},
    {"ping_pongs_per_h", "ping-pongs, 1/h", "", 2, better::less},
    {"hand_overs_per_h", "hand-overs, 1/h", "", 2, better::neither},
    {"latency_mean_ms", "latency, mean, ms", "", 2, better::less},
    {"latency_p50_ms", "latency, median, ms", "", 2, better::less},
    {"latency_p95_ms", "latency, 95 %, ms", "", 2, better::less},
    {"latency_p99_ms", "latency, 99 %, ms", "p99 ms", 2, better::less},
    {"vehicle_cpu_percent", "planning on board, % of a core", "", 2,
     better::less},
    {"energy_j_per_km", "energy, J/km", "", 1, better::less},
    {"energy_on_board_j_per_km", "energy of planning on board, J/km", "", 1,
     better::less},
    {"energy_offloading_j_per_km", "energy of offloading, J/km", "", 1,
     better::less},
    {"energy_saved_percent", "energy saved, %", "saved %", 1, better::more},
    {"utilisation_percent", "utilisation of providers, %", "", 1,
     better::neither},
    {"rejected_percent", "rejected, %", "", 1, better::neither},
    {"fairness", "fairness (Jain)", "Jain", 3, better::more},
    {"messages_per_s", "signalling, messages/s", "", 2, better::less},
    {regret_name, "regret, %", "regret %", 1, better::less},
    {than_location_name, "than location, %", "", 1, better::less},
    {score_name, "score", "score", 4, better::less},
};

/// The figures of a run as far as it tells them.
class run_figures {
public:
  explicit run_figures(const study::measured_run& run) : run_{run} {}

  double must(const std::string& name) const { return run_.figure(name); }
  std::optional<double> may(const std::string& name) const {
    const auto found = run_.figures.find(name);
    return found != run_.figures.end() ? std::optional{found->second}
                                       : std::nullopt;
  }

  double vehicle_hours() const {
    return must("vehicles") * must("virtual_s") / hour_s;
  }
  double violations() const {
    return must("ended_by.qos_latency") + must("ended_by.qos_gap")
           + may("ended_by.implausible").value_or(0);
  }
  double offloaded_share() const { return may("offloaded_share").value_or(0); }
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

/// @returns the share of all workers' time that running services took.
double utilisation(const run_figures& run, const baseline& by) {
  double worker_s = 0;
  for (const auto& [kind, share] : by.utilisation_by) {
    const auto served = "services." + kind + ".served.";
    if (const auto mean_s = run.may(served + "time_s.mean"))
      worker_s += share * *mean_s * run.must(served + "count");
  }
  return worker_s / (by.providers * run.must("virtual_s"));
}

/// @returns how many messages of the protocol there were, as far as a run
/// tells: offers that came, and requests, answers and ends, each counted per
/// service.
double signalling(const run_figures& run) {
  constexpr double request_and_answer = 2;
  return run.must("offers") + request_and_answer * run.over_services("requests")
         + run.over_services("ended_by.");
}

/// @returns the mean cost of a planning cycle.
double score(const run_figures& run, const baseline& by) {
  const auto share = run.offloaded_share();
  const auto latency_s = run.may("latency_ms.mean").value_or(0) * 1e-3;
  const auto time = share * latency_s + (1 - share) * by.local_s;
  const auto cycles = run.vehicle_hours() * hour_s / by.period_s;
  const auto violated = cycles > 0 ? run.violations() / cycles : 0;
  return of_time * time / by.limit_s + of_energy * (1 - run.energy_saved())
         + of_violations * violated;
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

} // namespace

std::span<const criterion> criteria() {
  return all_criteria;
}

baseline baseline_of(const scenario& s) {
  baseline by;
  const auto& channel = *s.network.channel;
  for (const auto& kind : s.services) {
    const auto& options = kind->options;
    by.utilisation_by.emplace(kind->name(),
                              channel.mean_service_s() * options.demand
                                  / to_seconds(options.period)
                                  / static_cast<double>(channel.workers));
    if (kind->name() != study::planning)
      continue;
    by.limit_s = to_seconds(options.limits.max_latency);
    by.period_s = to_seconds(options.period);
    by.local_s = to_seconds(options.run_time_mean);
  }
  by.providers = static_cast<double>(s.providers.size());
  return by;
}

judged_run judge(const study::measured_run& measured, const baseline& by) {
  const run_figures run{measured};
  judged_run judged;
  judged.seed = measured.point.seed;
  if (!measured.point.labels.empty())
    judged.entrant = measured.point.labels.front();
  auto& to = judged.values;
  const auto add = [&to](std::string_view name, std::optional<double> value,
                         double scale = 1) {
    if (value)
      to.emplace(name, scale * *value);
  };
  const auto hours = run.vehicle_hours();
  const auto per_hour = [&](std::string_view name, double count) {
    if (hours > 0)
      add(name, count / hours);
  };
  add("offloaded_percent", run.may("offloaded_share"), percent);
  per_hour("violations_per_h", run.violations());
  per_hour("without_plan_s_per_h", run.must("safety.without_fresh_plan_s"));
  add("collisions", run.must("safety.collisions"));
  per_hour("fallbacks_per_h", run.must("fallbacks"));
  per_hour("ping_pongs_per_h", run.must("ping_pongs"));
  per_hour("hand_overs_per_h", run.must("hand_overs"));
  add("latency_mean_ms", run.may("latency_ms.mean"));
  add("latency_p50_ms", run.may("latency_ms.p50"));
  add("latency_p95_ms", run.may("latency_ms.p95"));
  add("latency_p99_ms", run.may("latency_ms.p99"));
  if (by.period_s > 0)
    add("vehicle_cpu_percent",
        (1 - run.offloaded_share()) * by.local_s / by.period_s, percent);
  const auto per_km = run.may("energy.per_km_j");
  add("energy_j_per_km", per_km);
  if (const auto all_j = run.may("energy.j"); per_km && all_j > 0.0) {
    add("energy_on_board_j_per_km", run.may("energy.local_j"),
        *per_km / *all_j);
    add("energy_offloading_j_per_km", run.may("energy.offloading_j"),
        *per_km / *all_j);
  }
  add("energy_saved_percent", run.may("energy.saved_share"), percent);
  if (by.providers > 0)
    add("utilisation_percent", utilisation(run, by), percent);
  if (const auto requests = run.must("requests"); requests > 0)
    add("rejected_percent", run.must("rejected") / requests, percent);
  add("fairness", run.may("fairness"));
  add("messages_per_s", signalling(run) / run.must("virtual_s"));
  add(score_name, score(run, by));
  judged.safe = run.must("safety.without_fresh_plan_s") == 0
                && run.must("safety.off_road_s") == 0
                && run.must("safety.collisions") == 0;
  return judged;
}

void compare_scores(std::vector<judged_run>& runs) {
  compare(runs, "oracle", regret_name);
  compare(runs, "location", than_location_name);
}

} // namespace sofof::bench
