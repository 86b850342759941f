// A run in a store, and its cpu.csv read again.
#include "experiments/dehler2025/cpu_run.hpp"

#include "base/text/csv_reader.hpp"
#include "scenario/load.hpp"
#include "scenario/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <deque>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace sofof::experiments::study {

namespace {

namespace fs = std::filesystem;

/// What a run's cpu.csv says.
struct cpu_file {
  std::optional<recording::cpu_figures> planning;
  double v2x_at_most = 0; ///< See `measured_cpu`.
};

cpu_file read_cpu(const fs::path& file) {
  enum { station, actor, service, source, cpu_s, time_s, wakes };
  constexpr std::string_view columns[] = {
      "station", "actor", "service", "source", "cpu_s", "time_s", "wakes"};
  csv_reader rows{file, columns};
  std::deque<std::string> names; // which the table's lines refer to
  recording::cpu_table table;
  cpu_file all;
  while (rows.next()) {
    const auto turns = rows.whole(wakes);
    const auto cpu = from_seconds(rows.number(cpu_s));
    if (rows.text(actor) == "(measuring)" && turns > 0)
      table.look = cpu / (2 * static_cast<std::int64_t>(turns));
    const auto is_v2x =
        rows.text(actor) == "vehicle" || rows.text(actor) == "network_link";
    if (is_v2x && rows.number(time_s) > 0)
      all.v2x_at_most += 100 * rows.number(cpu_s) / rows.number(time_s);
    if (rows.text(station).empty())
      continue;
    table.lines.push_back({{static_cast<station_id>(rows.whole(station)),
                            messages::service_name{rows.text(service)},
                            rows.text(source) == "remote"},
                           names.emplace_back(rows.text(actor)),
                           cpu,
                           from_seconds(rows.number(time_s)),
                           turns});
  }
  all.planning = recording::figures_of(table, planning);
  return all;
}

} // namespace

fs::path make_cpu_run(const cpu_run& which, const run_store& store,
                      const std::atomic<bool>& interrupted) {
  const auto s = scenario::load_scenario(which.scenario, which.given);
  const auto name =
      fmt::format("{}-{}", which.name, name_of_run(s, which.program));
  if (store.summary_of(name))
    return store.folder_of(name);
  store.add(name, [&](const fs::path& folder) {
    scenario::run_options how;
    how.out = folder;
    how.realtime = true;
    how.cpu = true;
    how.version = which.version;
    std::ostream nowhere{nullptr};
    if (scenario::run(s, how, interrupted, nowhere)
        == scenario::run_outcome::failed)
      throw std::runtime_error{fmt::format(
          "the run {} on the wall's clock was unsafe; it needs an idle "
          "machine. The same command tries it again.",
          which.name)};
  });
  return store.folder_of(name);
}

measured_cpu read_cpu_runs(std::span<const fs::path> folders) {
  assert(!folders.empty());
  measured_cpu all;
  double distance_m = 0, driven_s = 0;
  for (const auto& folder : folders) {
    const auto cpu = read_cpu(folder / "cpu.csv");
    if (!cpu.planning)
      throw std::runtime_error{fmt::format(
          "no vehicle in {} was both local and offloaded.", folder.string())};
    all.runs.push_back(*cpu.planning);
    all.v2x_at_most = std::max(all.v2x_at_most, cpu.v2x_at_most);
    const auto drove = read_run({}, folder);
    distance_m += drove.figure("driving.distance_m");
    driven_s += drove.figure("safety.driven_s");
    all.length_s = drove.figure("virtual_s");
  }
  all.figures = recording::together(all.runs);
  all.speed_mps = distance_m / driven_s;
  return all;
}

} // namespace sofof::experiments::study
