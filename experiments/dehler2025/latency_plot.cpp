// The paper's latency plot: offloading time against the longest gap.
#include "experiments/dehler2025/area_time.hpp"
#include "experiments/dehler2025/offloading_time.hpp"
#include "experiments/dehler2025/paper.hpp"
#include "experiments/dehler2025/paper_figures.hpp"
#include "experiments/dehler2025/report_text.hpp"
#include "experiments/dehler2025/sections.hpp"
#include "experiments/dehler2025/share_interval.hpp"
#include "experiments/dehler2025/t_off_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace sofof::experiments::study {

namespace {

using report::curve;
using report::paragraph;

/// How many runs points have, and how long they are.
struct run_counts_of_points {
  std::uint64_t fewest = 0;
  std::uint64_t most = 0;
  std::uint64_t lasts_s = 0;
};

run_counts_of_points counts_of(const paper_runs& e) {
  run_counts_of_points all;
  if (e.latency_plot.empty())
    return all;
  for (const auto& n : labels_of(e.latency_plot, 0))
    for (const auto& gap : labels_of(e.latency_plot, 1)) {
      const std::uint64_t runs = those(e.latency_plot, n, gap).size();
      all.fewest = all.most == 0 ? runs : std::min(all.fewest, runs);
      all.most = std::max(all.most, runs);
    }
  all.lasts_s = static_cast<std::uint64_t>(
      std::lround(e.latency_plot.front().figure("virtual_s")));
  return all;
}

std::string length_of(const run_counts_of_points& x) {
  return fmt::format("{} s", x.lasts_s);
}

std::string text_of(const run_counts_of_points& x) {
  return x.fewest == x.most
             ? counted(x.most, "run")
             : fmt::format("{} to {}", x.fewest, counted(x.most, "run"));
}

report::figure offloading_times(const paper_runs& e, const report_text& text) {
  auto f = t_off_figure("Offloading time against the longest allowed gap");
  for (const auto& n : labels_of(e.latency_plot, 0))
    f.curves.push_back(t_off_curve(e.latency_plot, n, count_of_vehicles(n)));
  f.levels.emplace_back(
      paper::saturation_s,
      fmt::format("the paper's text: about {} s", paper::saturation_s));
  f.marks.emplace_back(paper::max_interarrival_ms, "the paper's choice");
  const auto counts = counts_of(e);
  f.caption = text.fill(
      "curves", {{"runs", text_of(counts)},
                 {"length", length_of(counts)},
                 {"saturation_s", fmt::format("{:g}", paper::saturation_s)}});
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

std::string with_interval(const std::optional<interval>& x) {
  return x ? fmt::format("{:.1f} ({:.1f}–{:.1f})", x->mean, x->low, x->high)
           : "–";
}

report::table saturation(const paper_runs& e, const report_text& text) {
  report::table t;
  t.title = "Where the curves saturate";
  t.columns = {"vehicles",
               "runs",
               "time in the area, s",
               "t_off at 150 ms, s",
               "share of that time",
               "early ends per pass",
               "seeds with an early end",
               "runs with one, 95 % interval"};
  for (const auto& n : labels_of(e.latency_plot, 0)) {
    const auto runs = those(e.latency_plot, n, longest_limit);
    const auto t_off = mean_t_off(runs);
    const auto stay = mean_time_in_area_s(those(e.in_area, 0, n));
    double early = 0, passes = 0;
    for (const auto& run : episodes_of(runs)) {
      early += run.early;
      passes += run.passes();
    }
    if (!t_off || !stay)
      continue;
    const auto seeds = seeds_with_early_ends(runs);
    const auto share = share_interval(seeds.size(), runs.size());
    t.rows.push_back({n, std::to_string(runs.size()),
                      fmt::format("{:.1f}", *stay), with_interval(t_off),
                      fmt::format("{:.1f} %", 100 * t_off->mean / *stay),
                      passes > 0 ? fmt::format("{:.2f}", early / passes) : "–",
                      in_a_list(seeds),
                      fmt::format("{:.0f} % ({:.0f}–{:.0f})", 100 * share.mean,
                                  100 * share.low, 100 * share.high)});
  }
  t.note = text.fill("stays");
  return t;
}

report::figure other_reading(const paper_runs& e, const report_text& text) {
  auto f = t_off_figure("The other reading: a narrow latency with rare stalls");
  for (const auto& n : {"1", "6"}) {
    f.curves.push_back(
        t_off_curve(e.stalls, n, count_of_vehicles(n) + ", stalls"));
    f.curves.push_back(
        t_off_curve(e.latency_plot, n, count_of_vehicles(n) + ", paper_sim"));
    f.curves.back().dashed = true;
  }
  f.caption = text.fill("stalls_curves");
  return f;
}

std::string plus_minus(double mean, double deviation, int digits) {
  return fmt::format("{:.{}f} ± {:.{}f}", mean, digits, deviation, digits);
}

paragraph about_the_ends(const report_text& text, const interval& one,
                         const interval& six) {
  const auto below = 100 * (1 - six.mean / one.mean);
  return {text.fill(
      "ends",
      {{"one_s", with_interval(one)},
       {"six_s", with_interval(six)},
       {"difference",
        text.fill(below >= 0 ? "below" : "above",
                  {{"percent", fmt::format("{:.0f}", std::abs(below))}})}})};
}

/// @returns how many early ends of six vehicles at the longest limit are for
/// a latency.
std::string causes_of(const paper_runs& e, const report_text& text) {
  std::uint64_t early = 0, late = 0;
  for (const auto* run : those(e.latency_plot, "6", longest_limit)) {
    early += run->ended_early;
    late += run->ended_late;
  }
  return text.fill("causes",
                   {{"early", std::to_string(early)},
                    {"late", std::to_string(late)},
                    {"l_max_ms", fmt::format("{}", paper::max_latency_ms)}});
}

paragraph about_more_vehicles(const paper_runs& e, const report_text& text) {
  auto all = text.fill("one_worker") + ' ' + causes_of(e, text);
  const auto counts = counts_of(e);
  if (counts.most > 1)
    all += ' '
           + text.fill("phases", {{"runs", text_of(counts)},
                                  {"length", length_of(counts)}});
  const auto convoy = early_ends_per_hour(those(e.apart, 0, "convoy"));
  const auto equal = early_ends_per_hour(those(e.apart, 0, "equal"));
  all += ' '
         + text.fill("apart", {{"convoy", with_interval(convoy)},
                               {"equal", with_interval(equal)}});
  if (convoy && equal)
    all += ' '
           + text.fill(convoy->low > equal->high || equal->low > convoy->high
                           ? "apart_differ"
                           : "apart_open");
  return {all};
}

paragraph about_stalls(const paper_runs& e, const report_text& text) {
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
                 {"six", early(e.latency_plot, "6")}})};
}

} // namespace

report::section latency_plot(const paper_runs& e) {
  const auto text = report_text::of("latency_plot");
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
    s.blocks.emplace_back(about_the_ends(text, *one, *six));
  s.blocks.emplace_back(about_more_vehicles(e, text));
  s.blocks.emplace_back(other_reading(e, text));
  s.blocks.emplace_back(about_stalls(e, text));
  return s;
}

} // namespace sofof::experiments::study
