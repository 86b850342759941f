// Figures and a table for each sweep.
#include "experiments/dehler2025/describe_sweep.hpp"

#include "base/input_error.hpp"
#include "base/options/units.hpp"
#include "experiments/dehler2025/mean_interval.hpp"
#include "experiments/dehler2025/offloading_time.hpp"
#include "experiments/dehler2025/sweep_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>

namespace sofof::experiments::study {

namespace {

namespace fs = std::filesystem;
using runs_view = std::span<const measured_run* const>;

/// For an interval: those of fewer tell no more than the runs themselves.
constexpr std::size_t least_runs = 5;

/// A figure of some runs together.
struct measure {
  const char* title;
  const char* unit;
  std::function<std::optional<interval>(runs_view)> of;
  std::string note; ///< What its figures leave out.
};

/// @returns it without its ends where few runs have a value.
std::optional<interval> with_ends_of_many(std::optional<interval> x,
                                          std::size_t have) {
  constexpr auto none = std::numeric_limits<double>::quiet_NaN();
  if (x && have < least_runs)
    x->low = x->high = none;
  return x;
}

/// @returns the mean of what each run adds to `sums`, over what it adds to
/// `counts`.
std::optional<interval>
ratio(runs_view runs, const std::function<group(const measured_run&)>& part) {
  std::vector<group> groups;
  for (const auto* run : runs)
    if (const auto own = part(*run); own.count > 0)
      groups.push_back(own);
  return with_ends_of_many(mean_interval(groups), groups.size());
}

std::optional<interval> offloading_time(runs_view runs) {
  const auto episodes = episodes_of(runs);
  const auto have = std::ranges::count_if(
      episodes, [](const auto& run) { return run.count > 0; });
  return with_ends_of_many(mean_t_off(episodes),
                           static_cast<std::size_t>(have));
}

double driven_s(const measured_run& run) {
  return run.figure("safety.driven_s");
}

std::optional<interval> offloaded_share(runs_view runs) {
  return ratio(runs, [](const measured_run& run) {
    const auto time_s = driven_s(run);
    const auto share = run.figures.find("offloaded_share");
    return share == run.figures.end() ? group{}
                                      : group{share->second * time_s, time_s};
  });
}

std::optional<interval> mean_latency(runs_view runs) {
  return ratio(runs, [](const measured_run& run) {
    const auto mean = run.figures.find("latency_ms.mean");
    if (mean == run.figures.end())
      return group{};
    const auto count = run.figure("latency_ms.count");
    return group{mean->second * count, count};
  });
}

std::optional<interval> fallbacks_per_hour(runs_view runs) {
  constexpr double hour_s = 3600;
  return ratio(runs, [](const measured_run& run) {
    return group{run.figure("fallbacks"), driven_s(run) / hour_s};
  });
}

const std::vector<measure>& measures() {
  static const std::vector<measure> all{
      {"Offloading time", "t_off per episode, s", offloading_time,
       "Episodes that the end of a run cuts off are left out, as nobody knows "
       "how long they would have been: a point that has no others has no "
       "value."},
      {"Offloaded share", "share of driving time", offloaded_share, {}},
      {"Latency", "mean, ms", mean_latency, {}},
      {"Fallbacks", "per hour of driving", fallbacks_per_hour, {}},
  };
  return all;
}

/// @returns the number that a label is, ms of a duration; nullopt for others.
std::optional<double> number_of(const std::string& label) {
  if (const auto d = parse_duration(label))
    return to_milliseconds(*d);
  double x = 0;
  const auto* last = label.data() + label.size();
  const auto [end, error] = std::from_chars(label.data(), last, x);
  return error == std::errc{} && end == last ? std::optional{x} : std::nullopt;
}

/// @returns the axis with most values that are all numbers; nullopt if none
/// has two.
std::optional<std::size_t> axis_to_draw(const sweep_results& s) {
  std::optional<std::size_t> best;
  std::size_t most = 1;
  for (std::size_t axis = 0; axis < s.axes.size(); ++axis) {
    const auto labels = labels_of(s.runs, axis);
    const auto numbers = std::ranges::all_of(
        labels, [](const auto& x) { return number_of(x).has_value(); });
    if (numbers && labels.size() > most) {
      most = labels.size();
      best = axis;
    }
  }
  return best;
}

/// All runs of one point, whatever the seed.
struct point_runs {
  std::vector<std::string> labels;
  std::vector<const measured_run*> runs;
};

/// @returns the points in the order of the table.
std::vector<point_runs> points_in(const sweep_results& s) {
  std::vector<point_runs> all;
  std::map<std::vector<std::string>, std::size_t> places;
  for (const auto& run : s.runs) {
    const auto& labels = run.point.labels;
    const auto [place, is_new] = places.try_emplace(labels, all.size());
    if (is_new)
      all.push_back({labels, {}});
    all[place->second].runs.push_back(&run);
  }
  return all;
}

report::figure figure_of(const sweep_results& s, const measure& what,
                         std::size_t axis) {
  report::figure f;
  f.title = what.title;
  const auto durations =
      parse_duration(s.runs.front().point.labels[axis]).has_value();
  f.x_label = s.axes[axis] + (durations ? ", ms" : "");
  f.y_label = what.unit;
  f.caption = fmt::format("Means over all seeds together, with 95 % intervals "
                          "over runs where {} or more have a value.",
                          least_runs);
  if (!what.note.empty())
    f.caption += ' ' + what.note;
  std::map<std::string, std::map<double, interval>> curves;
  for (const auto& [labels, runs] : points_in(s)) {
    std::string name;
    for (std::size_t i = 0; i < labels.size(); ++i)
      if (i != axis)
        name += fmt::format("{}{} = {}", name.empty() ? "" : ", ", s.axes[i],
                            labels[i]);
    if (const auto x = what.of(runs))
      curves[name][number_of(labels[axis]).value()] = *x;
  }
  for (const auto& [name, values] : curves) {
    auto& c = f.curves.emplace_back();
    c.name = name.empty() ? s.name : name;
    for (const auto& [x, y] : values) {
      c.x.push_back(x);
      c.y.push_back(y.mean);
      c.low.push_back(y.low);
      c.high.push_back(y.high);
    }
  }
  return f;
}

report::table table_of(const sweep_results& s) {
  report::table t;
  t.title = "All points";
  t.columns = s.axes;
  t.columns.emplace_back("runs");
  for (const auto& what : measures())
    t.columns.push_back(fmt::format("{}, {}", what.title, what.unit));
  for (const auto& [labels, runs] : points_in(s)) {
    auto row = labels;
    row.push_back(std::to_string(runs.size()));
    for (const auto& what : measures()) {
      const auto x = what.of(runs);
      row.push_back(x ? fmt::format("{:.3f}", x->mean) : "–");
    }
    t.rows.push_back(std::move(row));
  }
  t.note = measures().front().note;
  return t;
}

report::section section_of(const sweep_results& s) {
  report::section all{s.name, {}};
  all.blocks.emplace_back(
      report::paragraph{fmt::format("{} runs, {} of them unsafe; {} failed.",
                                    s.runs.size(), s.unsafe, s.failed)});
  if (const auto axis = axis_to_draw(s))
    for (const auto& what : measures())
      all.blocks.emplace_back(figure_of(s, what, *axis));
  all.blocks.emplace_back(table_of(s));
  return all;
}

} // namespace

bool is_sweep_folder(const fs::path& folder) {
  return fs::is_directory(folder / "runs")
         && !fs::exists(folder / "config.toml");
}

report::document describe_sweeps(const fs::path& folder,
                                 std::string_view version) {
  std::set<fs::path> tables;
  for (const auto& entry : fs::directory_iterator{folder})
    if (entry.path().extension() == ".csv" && is_sweep_table(entry.path()))
      tables.insert(entry.path());
  if (tables.empty())
    throw input_error{fmt::format("{}: no sweep has come to its end here; the "
                                  "same `sofof sweep` goes on.",
                                  folder.string())};
  report::document all;
  for (const auto& table : tables) {
    const auto s = read_swept(table);
    all.title += (all.title.empty() ? "" : " · ") + s.name;
    all.sections.push_back(section_of(s));
  }
  all.subtitle = fmt::format("report by sofof {}", version);
  return all;
}

} // namespace sofof::experiments::study
