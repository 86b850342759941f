// The paper's latency plot: offloading time against the longest gap.
#include "base/options/units.hpp"
#include "experiments/dehler2025/area_time.hpp"
#include "experiments/dehler2025/paper.hpp"
#include "experiments/dehler2025/sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace sofof::study {

namespace {

using report::curve;
using report::paragraph;

double ms_of(const std::string& duration_text) {
  return to_milliseconds(parse_duration(duration_text).value());
}

curve curve_of(std::span<const measured_run> runs, const std::string& vehicles,
               const std::string& name) {
  curve c;
  c.name = name;
  for (const auto& gap : labels_of(runs, 1)) {
    const auto t = mean_t_off(those(runs, vehicles, gap));
    constexpr auto none = std::numeric_limits<double>::quiet_NaN();
    c.x.push_back(ms_of(gap));
    c.y.push_back(t ? t->mean : none);
    c.low.push_back(t ? t->low : none);
    c.high.push_back(t ? t->high : none);
  }
  return c;
}

std::string name_of(const std::string& vehicles) {
  return vehicles == "1" ? "1 vehicle" : vehicles + " vehicles";
}

report::figure offloading_times(const paper_runs& e) {
  report::figure f;
  f.title = "Offloading time against the longest allowed gap";
  f.x_label = "Δt_max, ms";
  f.y_label = "t_off per accepted request, s";
  for (const auto& n : labels_of(e.latency_plot, 0))
    f.curves.push_back(curve_of(e.latency_plot, n, name_of(n)));
  curve saturation{"the paper: saturates at", {10, 150}, {}, {}, {}};
  saturation.y = {paper::saturation_s, paper::saturation_s};
  saturation.dashed = true;
  f.curves.push_back(std::move(saturation));
  f.marks.emplace_back(paper::max_interarrival_ms, "the paper's choice");
  f.caption =
      "Means over all episodes of ten runs of 3 minutes each; bands are "
      "95 % bootstrap intervals over runs.";
  return f;
}

report::table all_means(const paper_runs& e) {
  report::table t;
  t.title = "t_off in seconds: mean and its 95 % interval";
  t.columns = {"vehicles"};
  const auto gaps = labels_of(e.latency_plot, 1);
  t.columns.insert(t.columns.end(), gaps.begin(), gaps.end());
  for (const auto& n : labels_of(e.latency_plot, 0)) {
    std::vector<std::string> row{n};
    for (const auto& gap : gaps) {
      const auto x = mean_t_off(those(e.latency_plot, n, gap));
      row.push_back(
          x ? fmt::format("{:.2f} ({:.2f}–{:.2f})", x->mean, x->low, x->high)
            : "–");
    }
    t.rows.push_back(std::move(row));
  }
  return t;
}

report::table saturation(const paper_runs& e) {
  report::table t;
  t.title = "Where the curves saturate";
  t.columns = {"vehicles", "time in the area, s", "t_off at 150 ms, s",
               "share of that time", "early ends per pass"};
  for (const auto& n : labels_of(e.latency_plot, 0)) {
    const auto runs = those(e.latency_plot, n, "150ms");
    const auto t_off = mean_t_off(runs);
    const auto stay = mean_time_in_area_s(those(e.in_area, 0, n));
    double early = 0, episodes = 0;
    for (const auto* run : runs) {
      early += static_cast<double>(run->ended_early);
      episodes += static_cast<double>(run->t_off_s.size());
    }
    if (!t_off || !stay)
      continue;
    t.rows.push_back(
        {n, fmt::format("{:.1f}", *stay), fmt::format("{:.1f}", t_off->mean),
         fmt::format("{:.1f} %", 100 * t_off->mean / *stay),
         episodes > early ? fmt::format("{:.2f}", early / (episodes - early))
                          : "–"});
  }
  t.note = "The time in the area is that of vehicles that plan for themselves. "
           "An episode that ends early is followed by another one in the same "
           "pass, a second later.";
  return t;
}

report::figure other_reading(const paper_runs& e) {
  report::figure f;
  f.title = "The other reading: a narrow latency with rare stalls";
  f.x_label = "Δt_max, ms";
  f.y_label = "t_off per accepted request, s";
  for (const auto& n : {"1", "6"}) {
    f.curves.push_back(curve_of(e.stalls, n, name_of(n) + ", stalls"));
    f.curves.push_back(curve_of(e.latency_plot, n, name_of(n) + ", paper_sim"));
    f.curves.back().dashed = true;
  }
  f.caption = "Solid: with stalls, planned by `lane_follow`.";
  return f;
}

std::string with_interval(const std::optional<interval>& x) {
  return x ? fmt::format("{:.1f} ({:.1f}–{:.1f})", x->mean, x->low, x->high)
           : "–";
}

/// @returns violations per hour of offloading, which the end of a run does not
/// bias, whatever it cuts off.
std::optional<interval>
early_ends_per_hour(std::span<const measured_run* const> runs) {
  constexpr double hour_s = 3600;
  std::vector<group> groups;
  for (const auto* run : runs)
    groups.push_back({static_cast<double>(run->ended_early),
                      run->figure("offloaded_share") * run->figure("vehicles")
                          * run->figure("virtual_s") / hour_s});
  constexpr std::uint64_t seed = 1;
  return bootstrap(groups, random_stream{seed, "early_ends_per_hour"});
}

paragraph what_the_paper_says() {
  return {"The paper's latency plot has the mean offloading time per accepted "
          "request, for one to six vehicles on two round trips through "
          "Ulm-Lehr, 30 minutes for each point. It describes the curves: they "
          "rise with Δt_max, saturate near 70 s, the time in the area, rise "
          "more slowly with more vehicles, and that of six stays below the "
          "others."};
}

paragraph about_the_ends(const interval& one, const interval& six) {
  return {fmt::format(
      "One vehicle saturates at {} s, six at {} s, {:.0f} % below. Results are "
      "50 ms apart, give or take the difference of two latencies: with a "
      "shorter limit the first or second gap is too long. Times may be longer "
      "than that in the area, because the edge server learns from CAMs, some a "
      "second, that a vehicle has left; and convoys hold each other up, so "
      "that more vehicles take longer to pass.",
      with_interval(one), with_interval(six), 100 * (1 - six.mean / one.mean))};
}

paragraph about_more_vehicles(const paper_runs& e) {
  return {fmt::format(
      "Results of all vehicles wait for one worker at the edge server. What "
      "ends offloadings of many vehicles early is a latency above 50 ms, not a "
      "gap, so that all curves rise at the same Δt_max and differ in height. "
      "How often results meet depends on the phases of the planning cycles, "
      "which each run draws once: that is why each point is ten runs of 3 "
      "minutes instead of one of 30. The experiment (`apart.toml`, planned by "
      "`lane_follow`): six vehicles that are in the area together end {} "
      "offloadings early per hour of it, the same six spread over the round "
      "trip, about two in the area at a time, {}.",
      with_interval(early_ends_per_hour(those(e.apart, 0, "convoy"))),
      with_interval(early_ends_per_hour(those(e.apart, 0, "equal"))))};
}

paragraph about_stalls(const paper_runs& e) {
  const auto latency = pooled(those(e.stalls, "1", "150ms"), "latency_ms");
  const auto early = [](std::span<const measured_run> runs, const char* n) {
    return with_interval(early_ends_per_hour(those(runs, n, "150ms")));
  };
  return {fmt::format(
      "Mean and spread of 10.54 ± 9.83 ms can come from a wide distribution "
      "without outliers (`paper_sim`) or from a narrow one with rare stalls "
      "(`paper_sim_stalls`, one in 74 s), as measured 5G networks have them. "
      "What a stall holds back ends the offloading and is no latency of it: "
      "results that arrive have {:.1f} ± {:.1f} ms then. One vehicle with "
      "stalls ends {} offloadings early per hour of it, six of them {}; "
      "without stalls {} and {}, all at 150 ms. The paper describes a late "
      "rise, saturation near the time in the area, and six below the others: "
      "so are the curves of `paper_sim`.",
      latency.mean, latency.deviation, early(e.stalls, "1"),
      early(e.stalls, "6"), early(e.latency_plot, "1"),
      early(e.latency_plot, "6"))};
}

} // namespace

report::section latency_plot(const paper_runs& e) {
  report::section s{"Offloading time", {}};
  s.blocks.emplace_back(what_the_paper_says());
  s.blocks.emplace_back(offloading_times(e));
  s.blocks.emplace_back(all_means(e));
  s.blocks.emplace_back(saturation(e));
  const auto one = mean_t_off(those(e.latency_plot, "1", "150ms"));
  const auto six = mean_t_off(those(e.latency_plot, "6", "150ms"));
  if (one && six)
    s.blocks.emplace_back(about_the_ends(*one, *six));
  s.blocks.emplace_back(about_more_vehicles(e));
  s.blocks.emplace_back(other_reading(e));
  s.blocks.emplace_back(about_stalls(e));
  return s;
}

} // namespace sofof::study
