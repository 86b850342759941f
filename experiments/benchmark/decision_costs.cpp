// Adding up timing.csv.
#include "experiments/benchmark/decision_costs.hpp"

#include "base/text/csv.hpp"
#include "base/text/csv_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string_view>

namespace sofof::experiments::bench {

namespace {

constexpr int us_places = 1;

constexpr csv_column<decision_cost> columns_of_costs[]{
    {"scenario", [](const auto& x) { return std::string_view{x.scenario}; }},
    {"entrant", [](const auto& x) { return std::string_view{x.entrant}; }},
    {"side", [](const auto& x) { return std::string_view{x.side}; }},
    {"decisions",
     [](const auto& x) { return static_cast<std::uint64_t>(x.decisions); }},
    {"mean_us", [](const auto& x) { return rounded(x.mean_us, us_places); }},
    {"p50_us", [](const auto& x) { return rounded(x.p50_us, us_places); }},
    {"p99_us", [](const auto& x) { return rounded(x.p99_us, us_places); }},
    {"max_us", [](const auto& x) { return rounded(x.max_us, us_places); }},
};

using figures = std::map<std::string, double>;

figures read_timing(const std::filesystem::path& folder) {
  constexpr std::string_view columns[] = {"figure", "value"};
  csv_reader rows{folder / "timing.csv", columns};
  figures all;
  while (rows.next())
    if (const auto value = rows.number_if_any(1))
      all[rows.text(0)] = *value;
  return all;
}

/// @param all  At least one.
double median(std::vector<double> all) {
  std::ranges::sort(all);
  const auto middle = all.size() / 2;
  return all.size() % 2 == 1 ? all[middle]
                             : (all[middle - 1] + all[middle]) / 2;
}

using cost_figure = std::optional<double> (*)(const decision_cost&);

std::optional<double> slowest(std::span<const decision_cost> costs,
                              const std::string& entrant,
                              const std::string& scenario, cost_figure of) {
  std::optional<double> most;
  for (const auto& cost : costs)
    if (cost.entrant == entrant
        && (scenario.empty() || cost.scenario == scenario))
      if (const auto us = of(cost))
        most = std::max(most.value_or(0), *us);
  return most;
}

std::optional<decision_cost> cost_of(const timed_runs& runs,
                                     const std::vector<figures>& timings,
                                     const std::string& side) {
  decision_cost cost{runs.entrant, runs.scenario, side};
  double sum_us = 0;
  std::vector<double> p50;
  for (const auto& timing : timings) {
    const auto count = timing.find(side + "_decisions");
    if (count == timing.end())
      continue;
    const auto figure = [&](std::string_view what) {
      const auto found =
          timing.find(fmt::format("{}_decide_{}_us", side, what));
      return found != timing.end() ? found->second : 0;
    };
    cost.decisions += count->second;
    sum_us += count->second * figure("mean");
    p50.push_back(figure("p50"));
    if (count->second >= fewest_for_p99)
      cost.p99_us =
          std::min(cost.p99_us.value_or(figure("p99")), figure("p99"));
    cost.max_us = std::max(cost.max_us, figure("max"));
  }
  if (cost.decisions <= 0)
    return std::nullopt;
  cost.mean_us = sum_us / cost.decisions;
  cost.p50_us = median(std::move(p50));
  return cost;
}

} // namespace

std::vector<decision_cost>
read_decision_costs(std::span<const timed_runs> all) {
  std::vector<decision_cost> costs;
  for (const auto& runs : all) {
    std::vector<figures> timings;
    for (const auto& folder : runs.folders)
      timings.push_back(read_timing(folder));
    for (const auto* side : {"lodm", "codm"})
      if (auto cost = cost_of(runs, timings, side))
        costs.push_back(*std::move(cost));
  }
  return costs;
}

std::optional<double> slowest_p50_us(std::span<const decision_cost> costs,
                                     const std::string& entrant,
                                     const std::string& scenario) {
  return slowest(costs, entrant, scenario, [](const decision_cost& x) {
    return std::optional{x.p50_us};
  });
}

std::optional<double> slowest_p99_us(std::span<const decision_cost> costs,
                                     const std::string& entrant,
                                     const std::string& scenario) {
  return slowest(costs, entrant, scenario,
                 [](const decision_cost& x) { return x.p99_us; });
}

std::string to_csv(std::span<const decision_cost> costs) {
  const csv_columns<decision_cost> columns = columns_of_costs;
  std::string text;
  append_names(text, columns);
  text += '\n';
  for (const auto& cost : costs) {
    append_fields(text, columns, cost);
    text += '\n';
  }
  return text;
}

} // namespace sofof::experiments::bench
