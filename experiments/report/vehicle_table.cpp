// The columns of vehicles.csv that a reader looks for.
#include "experiments/report/vehicle_table.hpp"

#include "base/text/csv_reader.hpp"
#include "experiments/report/documented.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

namespace sofof::experiments::report {

namespace {

struct column {
  std::string_view name;
  std::string_view shown;
  int decimals;
};

constexpr std::array vehicle_columns{
    column{"station", "vehicle", 0},
    column{"distance_m", "way, m", 0},
    column{"plans", "plans", 0},
    column{"emergency_plans", "emergency plans", 0},
    column{"safe_stops", "safe stops", 0},
    column{"collisions", "collisions", 0},
    column{"max_plan_age_ms", "oldest plan, ms", 1},
    column{"min_accel_mps2", "lowest acceleration, m/s²", 2},
    column{"max_jerk_mps3", "largest jerk, m/s³", 2},
    column{"max_lateral_accel_mps2", "largest lateral acceleration, m/s²", 2},
    column{"hard_brakes", "hard brakes", 0},
    column{"comfort_cost_m2ps3", "comfort cost, m²/s³", 1},
    column{"delay_s", "delay, s", 1},
    column{"stops", "stops", 0},
    column{"longest_stop_s", "longest stop, s", 1},
};

} // namespace

table vehicle_table(const recorded_run& run) {
  const auto file = run.folder / "vehicles.csv";
  if (!std::filesystem::exists(file))
    return {};
  table all;
  std::vector<std::string_view> wanted;
  for (const auto& [name, shown, decimals] : vehicle_columns) {
    all.columns.emplace_back(shown);
    all.column_meanings.push_back(documented("vehicles.csv", name));
    wanted.push_back(name);
  }
  csv_reader line{file, wanted};
  while (line.next()) {
    auto& row = all.rows.emplace_back();
    for (std::size_t i = 0; i < vehicle_columns.size(); ++i) {
      const auto x = line.number_if_any(i);
      row.push_back(x ? fmt::format("{:.{}f}", *x, vehicle_columns[i].decimals)
                      : "");
    }
  }
  return all;
}

} // namespace sofof::experiments::report
