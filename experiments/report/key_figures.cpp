// Which figures of a summary are shown, and under which name.
#include "experiments/report/key_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace sofof::report {

namespace {

struct shown_figure {
  std::string_view member; ///< Of the summary.
  std::string_view name;
  int decimals = 0;
  double scale = 1; ///< From the summary's unit to the shown one.
};

constexpr double percent = 100;
constexpr double ms_per_s = 1000;
constexpr double km_per_m = 1e-3;

constexpr shown_figure of_run[]{
    {"virtual_s", "length, s", 1},
    {"vehicles", "vehicles"},
    {"offers", "offers"},
    {"timing.wall_s", "computed in, s", 1},
    {"timing.x_real_time", "times real time", 1},
};

constexpr shown_figure of_service[]{
    {"requests", "requests"},
    {"accepted", "accepted"},
    {"rejected", "rejected"},
    {"no_data", "accepted, but no result came"},
    {"episodes", "episodes"},
    {"fallbacks", "fallbacks"},
    {"t_off_s.mean", "offloading time, mean, s", 2},
    {"t_off_s.max", "offloading time, longest, s", 2},
    {"offloaded_share", "offloaded share, %", 1, percent},
    {"latency_ms.count", "remote results"},
    {"results_used", "remote results used"},
    {"latency_ms.mean", "latency, mean, ms", 2},
    {"latency_ms.std", "latency, standard deviation, ms", 2},
    {"latency_ms.p50", "latency, median, ms", 2},
    {"latency_ms.p99", "latency, 99 %, ms", 2},
    {"latency_ms.max", "latency, longest, ms", 2},
    {"interarrival_ms.mean", "inter-arrival time, mean, ms", 2},
    {"interarrival_ms.p99", "inter-arrival time, 99 %, ms", 2},
    {"interarrival_ms.max", "inter-arrival time, longest, ms", 2},
    {"served.count", "served by providers"},
    {"served.time_s.mean", "served, mean, s", 2},
};

constexpr shown_figure of_safety[]{
    {"safety.without_fresh_plan_s", "without a fresh plan, s", 3},
    {"safety.off_road_s", "off the road, s", 3},
    {"safety.collisions", "collisions"},
    {"safety.max_plan_age_s", "oldest plan in use, ms", 1, ms_per_s},
    {"plans.count", "plans"},
    {"plans.emergency", "emergency plans"},
    {"plans.safe_stops", "safe stops"},
    {"driving.distance_m", "way driven, km", 2, km_per_m},
    {"driving.max_lateral_accel_mps2", "lateral acceleration, largest, m/s²",
     2},
    {"driving.max_jerk_mps3", "jerk, largest, m/s³", 2},
    {"driving.min_accel_mps2", "acceleration, lowest, m/s²", 2},
    {"driving.hard_brakes", "hard brakes"},
    {"driving.comfort_cost_m2ps3", "comfort cost, m²/s³", 1},
    {"energy.per_km_j", "energy of planning in the vehicles, J/km", 1},
    {"energy.saved_share", "energy saved by offloading, %", 1, percent},
    {"switch.count", "changes of the plan's source"},
    {"switch.max_d_m", "jump at a change, largest, m", 3},
};

constexpr shown_figure on_air[]{
    {"v2x.cam.messages", "CAMs"},
    {"v2x.cam.mean_octets", "CAM, mean octets", 1},
    {"v2x.cpm.messages", "CPMs"},
    {"v2x.cpm.mean_octets", "CPM, mean octets", 1},
    {"v2x.mcm_up.messages", "MCMs up"},
    {"v2x.mcm_up.mean_octets", "MCM up, mean octets", 1},
    {"v2x.mcm_down.messages", "MCMs down"},
    {"v2x.mcm_down.mean_octets", "MCM down, mean octets", 1},
};

class figure_table {
public:
  figure_table(std::span<const recorded_run> runs, std::string title)
      : runs_{runs} {
    table_.title = std::move(title);
    table_.columns.emplace_back("figure");
    for (const auto& run : runs)
      table_.columns.push_back(runs.size() == 1 ? "value" : run.label);
    if (runs.size() == 2)
      table_.columns.emplace_back("difference");
  }

  void add(const shown_figure& figure, const std::string& prefix = "") {
    add(prefix + std::string{figure.member}, figure.name, figure.decimals,
        figure.scale);
  }

  void add(const std::string& member, std::string_view name, int decimals = 0,
           double scale = 1) {
    std::vector<std::string> row{std::string{name}};
    std::vector<double> values;
    for (const auto& run : runs_) {
      const auto value = run.figure(member);
      row.push_back(value ? fmt::format("{:.{}f}", *value * scale, decimals)
                          : "–");
      if (value)
        values.push_back(*value * scale);
    }
    if (values.empty())
      return;
    if (runs_.size() == 2)
      row.push_back(values.size() == 2
                        ? difference(values[1] - values[0], decimals)
                        : "–");
    table_.rows.push_back(std::move(row));
  }

  void finish(std::vector<table>& all) && {
    if (!table_.rows.empty())
      all.push_back(std::move(table_));
  }

private:
  static std::string difference(double x, int decimals) {
    const auto text = fmt::format("{:+.{}f}", x, decimals);
    const auto nothing = text.find_first_of("123456789") == text.npos;
    return nothing ? "0" : text;
  }

  std::span<const recorded_run> runs_;
  table table_;
};

void add_table(std::vector<table>& all, std::span<const recorded_run> runs,
               std::string title, std::span<const shown_figure> figures) {
  figure_table shown{runs, std::move(title)};
  for (const auto& figure : figures)
    shown.add(figure);
  std::move(shown).finish(all);
}

/// Adds why offloadings ended, as far as any did so.
void add_endings(figure_table& to, std::span<const recorded_run> runs,
                 const std::string& prefix) {
  std::set<std::string> members;
  for (const auto& run : runs)
    if (run.figures)
      for (const auto& [member, count] : *run.figures)
        if (member.starts_with(prefix) && count > 0)
          members.insert(member);
  for (const auto& member : members)
    to.add(member, "ended by " + member.substr(prefix.size()));
}

/// Adds whose results were refused, by check: PROVIDER.CHECK.
void add_refusals(figure_table& to, std::span<const recorded_run> runs,
                  const std::string& prefix) {
  std::set<std::string> members;
  for (const auto& run : runs)
    if (run.figures)
      for (const auto& [member, count] : *run.figures)
        if (member.starts_with(prefix))
          members.insert(member);
  for (const auto& member : members) {
    const auto name = member.substr(prefix.size());
    const auto dot = name.rfind('.');
    to.add(member, fmt::format("implausible results of {}: {}",
                               name.substr(0, dot), name.substr(dot + 1)));
  }
}

} // namespace

std::vector<table> key_figures(std::span<const recorded_run> runs) {
  std::vector<table> all;
  add_table(all, runs, "The run", of_run);
  for (const auto& service : services_of(runs)) {
    const auto prefix = "services." + service + '.';
    figure_table shown{runs, "Offloading of " + service};
    for (const auto& figure : of_service)
      shown.add(figure, prefix);
    add_endings(shown, runs, prefix + "ended_by.");
    add_refusals(shown, runs, prefix + "implausible.");
    std::move(shown).finish(all);
  }
  add_table(all, runs, "Safety and comfort", of_safety);
  add_table(all, runs, "On the air", on_air);
  return all;
}

} // namespace sofof::report
