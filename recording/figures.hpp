// The table of all figures of a run: what each is called in summary.json, how
// it is reckoned, and how the console and reports show it. Who shows figures
// reads them from here, so that a further one is one entry. Meanings:
// docs/results.md.
#pragma once

#include "recording/metrics.hpp"
#include "recording/run_info.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace sofof::recording {

/// A count, a number or a time; nothing where a run does not tell it.
using figure_value = std::variant<bool, std::uint64_t, std::optional<double>,
                                  std::optional<duration>>;

/// What figures of a whole run are reckoned from.
struct whole_run {
  const metrics& of;
  const run_info& run;
  const run_end& end;
};

/// What figures of one service are reckoned from.
struct service_in_run {
  const service_metrics& of;
  const metrics& all;
  const run_info& run;
  const run_end& end;
};

/// The tables of a report.
enum class report_table : std::uint8_t {
  none,
  run,
  service,
  safety,
  traffic,
  air
};

/// What stands together on the console, with nothing between.
enum class console_block : std::uint8_t {
  none,
  asked,
  offloaded,
  results,
  provided,
  provided_time,
  safety,
  comfort,
  traffic,
  energy
};

/// How a report shows a figure.
struct in_report {
  report_table in = report_table::none;
  int place = 0;            ///< Among those of its table: ascending.
  std::string_view title{}; ///< With its unit.
  int decimals = 0;
  double scale = 1; ///< From the summary's unit to the shown one.
};

/// How the console shows a figure.
template <class Of>
struct on_console {
  console_block in = console_block::none;
  int place = 0; ///< Among those of its block: ascending.
  std::string_view label{};
  int decimals = 0;
  std::string_view unit{};
  double scale = 1; ///< From the summary's unit to the shown one.
  /// Instead of the figure alone.
  std::string (*text)(const Of& of) = nullptr;
};

/// One figure of `Of`.
template <class Of>
struct figure {
  std::string_view name; ///< In the summary: a path with dots, and the unit.
  int places;            ///< Decimals there, of a number.
  figure_value (*value)(const Of& of);
  in_report report;
  on_console<Of> console;

  /// @param value  Without captures: makes the figure of `Of`.
  template <class Value>
  constexpr figure(std::string_view name, int places, Value,
                   in_report report = {}, on_console<Of> console = {})
      : name{name}, places{places}, value{[](const Of& of) -> figure_value {
          return std::invoke(Value{}, of);
        }},
        report{report}, console{console} {}
};

using run_figure = figure<whole_run>;
using service_figure = figure<service_in_run>;

// All figures, in the order of the summary.

/// The run itself.
std::span<const run_figure> run_figures();
/// Each service, as the requesters see it.
std::span<const service_figure> service_figures();
/// Each service, as the providers see it.
std::span<const service_figure> served_figures();
/// What each service took.
std::span<const service_figure> service_cost_figures();
/// All vehicles together.
std::span<const run_figure> vehicle_figures();
/// What all services took.
std::span<const run_figure> run_cost_figures();
/// The wall's clock.
std::span<const run_figure> clock_figures();

/// How a report shows a figure of the summary.
struct reported_figure {
  std::string_view name; ///< In the summary.
  in_report how;
};

/// @returns the figures of a table of a report, in their order; those of
/// services by their names below `services.NAME`.
std::vector<reported_figure> reported_in(report_table table);

} // namespace sofof::recording
