// Holds a run's results to what SOFOF promises: all checks together, and
// safety.
#include "experiments/torture/promises.hpp"

#include "base/input_error.hpp"
#include "base/text/csv_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace sofof::experiments::torture {

namespace {

/// @throws input_error where a run left no such file.
template <class T>
T required(std::optional<T> file, std::string_view name) {
  if (!file)
    throw input_error{fmt::format("the run has written no {}.", name)};
  return std::move(*file);
}

/// Checks of plans by what only the vehicle, or only the provider, may see: a
/// body, or that there is none.
constexpr std::array<std::string_view, 3> may_not_be_known{"others", "braking",
                                                           "standing"};

/// Of sums of times with nine decimals.
constexpr double rounding_of_sums_s = 1e-6;

} // namespace

double finished_run::figure(const std::string& name) const {
  const auto found = summary.figures.find(name);
  return found == summary.figures.end() ? 0 : found->second;
}

finished_run read_finished(const scenario::scenario_definition& what,
                           const std::filesystem::path& folder) {
  return {what,
          folder,
          required(report::read_summary(folder), "summary.json"),
          report::read_episodes(folder),
          required(report::read_cycles(folder), "cycles.csv"),
          report::read_octets(folder),
          report::read_load(folder),
          required(report::read_disturbed(folder), "disturbed.csv"),
          report::read_events(folder)};
}

std::optional<double> dies_at_s(const scenario::scenario_definition& s,
                                std::uint64_t station) {
  for (const auto& f : s.fleets) {
    const auto first = static_cast<std::uint64_t>(f.first_station);
    if (f.fails_at && *f.fails_at < s.length && station >= first
        && station < first + static_cast<std::uint64_t>(f.count))
      return to_seconds(*f.fails_at);
  }
  return std::nullopt;
}

bool any_dies(const scenario::scenario_definition& s) {
  return std::ranges::any_of(s.fleets, [&s](const auto& f) {
    return f.fails_at && *f.fails_at < s.length;
  });
}

void check_safety(const finished_run& run, broken_promises& to) {
  static constexpr std::array<std::string_view, 4> columns{
      "station", "without_fresh_plan_s", "off_road_s", "collisions"};
  csv_reader rows{run.folder / "vehicles.csv", columns};
  double without_s = 0, off_road_s = 0;
  while (rows.next()) {
    const auto station = rows.whole(0);
    const auto zero = [&](std::size_t column, std::string promise) {
      if (const auto x = rows.number(column); x != 0)
        to.push_back(
            {std::move(promise), fmt::format("{} of station {} is {}",
                                             columns[column], station, x)});
    };
    if (!dies_at_s(run.what, station))
      zero(1, "fresh_plan");
    if (!run.has_liars) // who is believed for half a second
      zero(2, "on_the_road");
    zero(3, "no_collision");
    without_s += rows.number(1);
    off_road_s += rows.number(2);
  }
  const auto same = [&](const std::string& figure, double sum) {
    if (std::abs(run.figure(figure) - sum) > rounding_of_sums_s)
      to.push_back({"adds_up", fmt::format("{} is {}, but vehicles.csv says {}",
                                           figure, run.figure(figure), sum)});
  };
  same("safety.without_fresh_plan_s", without_s);
  same("safety.off_road_s", off_road_s);
}

void check_belief(const finished_run& run, broken_promises& to) {
  if (run.has_liars || run.has_ghosts)
    return;
  for (const auto& e : run.events) {
    const auto what = e.detail.substr(0, e.detail.find(' '));
    if (e.what == "implausible"
        && std::ranges::find(may_not_be_known, what) == may_not_be_known.end())
      to.push_back({"believed",
                    fmt::format("station {} took {} for a liar at {:.6f} s: {}",
                                e.of.station, e.of.provider, e.t_s, e.detail)});
  }
}

broken_promises check(const finished_run& run) {
  broken_promises all;
  check_safety(run, all);
  check_belief(run, all);
  check_sources(run, all);
  check_chain(run, all);
  check_ledger(run, all);
  check_sums(run, all);
  check_octets(run, all);
  check_conformance(run, all);
  return all;
}

} // namespace sofof::experiments::torture
