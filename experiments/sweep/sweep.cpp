// Points become runs, their summaries become a table.
#include "experiments/sweep/sweep.hpp"

#include "base/files/output_file.hpp"
#include "base/input_error.hpp"

#include <fmt/format.h>

#include <ostream>
#include <system_error>

namespace sofof::experiments {

namespace {

/// @param run_of  The name of the run of each point.
sweep_outcome gather(const sweep_plan& plan, const run_store& store,
                     const std::vector<std::string>& run_of,
                     std::filesystem::path table) {
  sweep_outcome outcome;
  std::vector<point_result> results;
  for (const auto& run : run_of) {
    const auto& result = results.emplace_back(
        point_result{run, store.summary_of(run).value_or("")});
    outcome.folders.push_back(result.failed() ? std::filesystem::path{}
                                              : store.folder_of(run));
    outcome.add(result);
  }
  outcome.table = std::move(table);
  write_file(outcome.table, point_table(plan, results));
  return outcome;
}

} // namespace

sweep_outcome sweep(const sweep_plan& plan, const sweep_options& options,
                    const std::atomic<bool>& interrupted,
                    std::ostream& console) {
  const auto wanted = runs_wanted_by(plan, options.program, interrupted);
  const run_store store{options.out};
  const file_lock lock{options.out / "runs" / ".lock"}; // of the table
  if (lock.is_taken())
    throw input_error{
        fmt::format("cannot keep runs in {}: another sweep is at "
                    "work there; choose another folder with --out",
                    options.out.string())};
  auto table = options.out / (plan.name + ".csv");
  std::error_code ignored;
  std::filesystem::remove(table, ignored); // it may be of other points
  for (const auto& problem : wanted.problems)
    console << problem << '\n';
  make_runs(wanted.runs, store, options, interrupted, console);
  if (interrupted) {
    sweep_outcome cut_short;
    cut_short.interrupted = true;
    return cut_short;
  }
  return gather(plan, store, wanted.run_of, std::move(table));
}

} // namespace sofof::experiments
