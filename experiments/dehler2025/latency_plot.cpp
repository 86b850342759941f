// The paper's latency plot: offloading time against the longest gap.
#include "experiments/dehler2025/area_time.hpp"
#include "experiments/dehler2025/curve_claims.hpp"
#include "experiments/dehler2025/paper.hpp"
#include "experiments/dehler2025/report_text.hpp"
#include "experiments/dehler2025/sections.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstdint>
#include <limits>

namespace sofof::experiments::study {

namespace {

using report::curve;
using report::paragraph;

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

/// How many runs a point has, and how long they are.
struct effort {
  std::uint64_t runs = 0;
  std::uint64_t minutes = 0;
};

effort effort_of(const paper_runs& e) {
  const auto point = those(e.latency_plot, "1", longest_limit);
  if (point.empty())
    return {};
  constexpr double minute_s = 60;
  return {point.size(), static_cast<std::uint64_t>(std::lround(
                            point.front()->figure("virtual_s") / minute_s))};
}

std::string length_of(const effort& x) {
  return fmt::format("{} minute{}", x.minutes, x.minutes == 1 ? "" : "s");
}

report::figure offloading_times(const paper_runs& e, const report_text& text) {
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
  const auto effort = effort_of(e);
  f.caption = text.fill("curves", {{"runs", counted(effort.runs, "run")},
                                   {"length", length_of(effort)}});
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

report::table saturation(const paper_runs& e, const report_text& text) {
  report::table t;
  t.title = "Where the curves saturate";
  t.columns = {"vehicles", "time in the area, s", "t_off at 150 ms, s",
               "share of that time", "early ends per pass"};
  for (const auto& n : labels_of(e.latency_plot, 0)) {
    const auto runs = those(e.latency_plot, n, longest_limit);
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
  t.note = text.fill("stays");
  return t;
}

report::figure other_reading(const paper_runs& e, const report_text& text) {
  report::figure f;
  f.title = "The other reading: a narrow latency with rare stalls";
  f.x_label = "Δt_max, ms";
  f.y_label = "t_off per accepted request, s";
  for (const auto& n : {"1", "6"}) {
    f.curves.push_back(curve_of(e.stalls, n, name_of(n) + ", stalls"));
    f.curves.push_back(curve_of(e.latency_plot, n, name_of(n) + ", paper_sim"));
    f.curves.back().dashed = true;
  }
  f.caption = text.fill("stalls_curves");
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

std::string plus_minus(double mean, double deviation, int digits) {
  return fmt::format("{:.{}f} ± {:.{}f}", mean, digits, deviation, digits);
}

/// @returns whether six vehicles that plan for themselves need longer than one.
bool pass_longer(const paper_runs& e) {
  const auto one = mean_time_in_area_s(those(e.in_area, 0, "1"));
  const auto six = mean_time_in_area_s(those(e.in_area, 0, "6"));
  return one && six && *six > *one;
}

paragraph about_the_ends(const paper_runs& e, const report_text& text,
                         const interval& one, const interval& six) {
  const auto below = 100 * (1 - six.mean / one.mean);
  return {text.fill(
      "ends",
      {{"one_s", with_interval(one)},
       {"six_s", with_interval(six)},
       {"difference",
        text.fill(below >= 0 ? "below" : "above",
                  {{"percent", fmt::format("{:.0f}", std::abs(below))}})},
       {"convoys",
        text.fill(pass_longer(e) ? "longer_passes" : "no_longer_passes")}})};
}

std::string rises(const report_text& text, const curve_claims& claims) {
  if (claims.rises_ms.empty())
    return text.fill("no_heights");
  return text.fill(
      "rises",
      {{"rises_ms", fmt::format("{}", fmt::join(claims.rises_ms, ", "))}});
}

paragraph about_more_vehicles(const paper_runs& e, const report_text& text,
                              const curve_claims& claims) {
  const auto l_max = fmt::format("{}", paper::max_latency_ms);
  auto all = text.fill("one_worker") + ' ';
  if (claims.late_results_only())
    all += text.fill("late_results", {{"l_max_ms", l_max}});
  else
    all += text.fill("other_causes", {{"l_max_ms", l_max},
                                      {"late", std::to_string(claims.late)},
                                      {"early", std::to_string(claims.early)},
                                      {"rises", rises(text, claims)}});
  const auto effort = effort_of(e);
  if (effort.runs > 1)
    all +=
        ' '
        + text.fill("phases",
                    {{"runs", counted(effort.runs, "run")},
                     {"length", length_of(effort)},
                     {"total", std::to_string(effort.runs * effort.minutes)}});
  return {all + ' '
          + text.fill("apart", {{"convoy", with_interval(early_ends_per_hour(
                                               those(e.apart, 0, "convoy")))},
                                {"equal", with_interval(early_ends_per_hour(
                                              those(e.apart, 0, "equal")))}})};
}

/// @returns what the sentence about the paper's description ends with.
std::string agreement(const report_text& text, const curve_claims& claims) {
  if (claims.rises_ms.empty())
    return text.fill("unknown");
  std::vector<std::string> missing;
  if (!claims.rise_late)
    missing.push_back(text.fill("late_rise"));
  if (!claims.saturates)
    missing.push_back(text.fill("saturation"));
  if (!claims.six_lowest)
    missing.push_back(text.fill("six_lowest"));
  return missing.empty()
             ? text.fill("agrees")
             : text.fill(
                 "differs",
                 {{"missing", fmt::format("{}", fmt::join(missing, ", no "))}});
}

paragraph about_stalls(const paper_runs& e, const report_text& text,
                       const curve_claims& claims) {
  const auto latency =
      pooled(those(e.stalls, "1", longest_limit), "latency_ms");
  const auto early = [](std::span<const measured_run> runs, const char* n) {
    return with_interval(early_ends_per_hour(those(runs, n, longest_limit)));
  };
  return {text.fill(
      "stalls", {{"latency_ms", plus_minus(paper::latency_mean_ms,
                                           paper::latency_deviation_ms, 2)},
                 {"arrived_ms", plus_minus(latency.mean, latency.deviation, 1)},
                 {"one_stalls", early(e.stalls, "1")},
                 {"six_stalls", early(e.stalls, "6")},
                 {"one", early(e.latency_plot, "1")},
                 {"six", early(e.latency_plot, "6")},
                 {"agreement", agreement(text, claims)}})};
}

} // namespace

report::section latency_plot(const paper_runs& e) {
  const auto text = report_text::of("latency_plot");
  const auto claims = claims_of(e);
  report::section s{"Offloading time", {}};
  s.blocks.emplace_back(paragraph{
      text.fill("the_paper",
                {{"saturation_s", fmt::format("{}", paper::saturation_s)}})});
  s.blocks.emplace_back(offloading_times(e, text));
  s.blocks.emplace_back(all_means(e));
  s.blocks.emplace_back(saturation(e, text));
  const auto one = mean_t_off(those(e.latency_plot, "1", longest_limit));
  const auto six = mean_t_off(those(e.latency_plot, "6", longest_limit));
  if (one && six)
    s.blocks.emplace_back(about_the_ends(e, text, *one, *six));
  s.blocks.emplace_back(about_more_vehicles(e, text, claims));
  s.blocks.emplace_back(other_reading(e, text));
  s.blocks.emplace_back(about_stalls(e, text, claims));
  return s;
}

} // namespace sofof::experiments::study
