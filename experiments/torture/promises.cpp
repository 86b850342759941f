// Holds a run's results to what SOFOF promises: all checks together, and
// safety.
#include "experiments/torture/promises.hpp"

#include "base/input_error.hpp"

#include <fmt/format.h>

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
          required(report::read_disturbed(folder), "disturbed.csv"),
          report::read_events(folder)};
}

void check_safety(const finished_run& run, broken_promises& to) {
  const auto zero = [&](const std::string& figure, std::string promise) {
    if (const auto x = run.figure(figure); x != 0)
      to.push_back({std::move(promise), fmt::format("{} is {}", figure, x)});
  };
  zero("safety.without_fresh_plan_s", "fresh_plan");
  zero("safety.off_road_s", "on_the_road");
  zero("safety.collisions", "no_collision");
}

broken_promises check(const finished_run& run) {
  broken_promises all;
  check_safety(run, all);
  check_sources(run, all);
  check_ledger(run, all);
  check_sums(run, all);
  check_octets(run, all);
  // Conformance of the protocol's trace belongs here.
  return all;
}

} // namespace sofof::experiments::torture
