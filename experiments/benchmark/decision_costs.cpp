// Adding up timing.csv.
#include "experiments/benchmark/decision_costs.hpp"

#include "base/text/csv.hpp"
#include "base/text/csv_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string_view>

namespace sofof::bench {

namespace {

constexpr int us_places = 1;

using figures = std::map<std::string, double>;

figures read_timing(const std::filesystem::path& folder) {
  constexpr std::string_view columns[] = {"figure", "value"};
  report::csv_reader rows{folder / "timing.csv", columns};
  figures all;
  while (rows.next())
    if (const auto value = rows.number_if_any(1))
      all[rows.text(0)] = *value;
  return all;
}

double median(std::vector<double> all) {
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::ranges::nth_element(all, middle);
  return *middle;
}

std::optional<decision_cost> cost_of(const timed_runs& runs,
                                     const std::vector<figures>& timings,
                                     const std::string& side) {
  decision_cost cost{runs.entrant, runs.scenario, side};
  double sum_us = 0;
  std::vector<double> p50, p99;
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
    p99.push_back(figure("p99"));
    cost.max_us = std::max(cost.max_us, figure("max"));
  }
  if (cost.decisions <= 0)
    return std::nullopt;
  cost.mean_us = sum_us / cost.decisions;
  cost.p50_us = median(std::move(p50));
  cost.p99_us = median(std::move(p99));
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

std::optional<double> slowest_p99_us(std::span<const decision_cost> costs,
                                     const std::string& entrant,
                                     const std::string& scenario) {
  std::optional<double> slowest;
  for (const auto& cost : costs)
    if (cost.entrant == entrant
        && (scenario.empty() || cost.scenario == scenario))
      slowest = std::max(slowest.value_or(0), cost.p99_us);
  return slowest;
}

std::string to_csv(std::span<const decision_cost> costs) {
  std::string text =
      "scenario,entrant,side,decisions,mean_us,p50_us,p99_us,max_us\n";
  for (const auto& cost : costs) {
    append(text, std::string_view{cost.scenario});
    for (const auto& cell : {cost.entrant, cost.side}) {
      text += ',';
      append(text, std::string_view{cell});
    }
    text += ',';
    append(text, static_cast<std::uint64_t>(cost.decisions));
    for (const auto us :
         {cost.mean_us, cost.p50_us, cost.p99_us, cost.max_us}) {
      text += ',';
      append(text, rounded(us, us_places));
    }
    text += '\n';
  }
  return text;
}

} // namespace sofof::bench
