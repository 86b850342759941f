// The paper's real drives, emulated.
#include "experiments/dehler2025/histogram.hpp"
#include "experiments/dehler2025/offloading_time.hpp"
#include "experiments/dehler2025/paper.hpp"
#include "experiments/dehler2025/report_text.hpp"
#include "experiments/dehler2025/sections.hpp"
#include "experiments/dehler2025/share_interval.hpp"
#include "experiments/report/run_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

namespace sofof::experiments::study {

namespace {

using report::curve;
using report::figure;
using report::paragraph;

/// How many of the drives of each seed ended early.
std::map<std::int64_t, int> early_ends(const paper_runs& e) {
  std::map<std::int64_t, int> by_seed;
  for (const auto& run : e.real_world)
    by_seed[run.point.seed] += run.ended_early > 0 ? 1 : 0;
  return by_seed;
}

std::vector<const measured_run*> all_of(std::span<const measured_run> runs) {
  std::vector<const measured_run*> all;
  for (const auto& run : runs)
    all.push_back(&run);
  return all;
}

report::table comparison(const paper_runs& e) {
  const auto all = all_of(e.real_world);
  const auto latency = pooled(all, "latency_ms");
  const auto early = early_ends(e);
  int least = std::numeric_limits<int>::max(), most = 0;
  std::uint64_t ended_early = 0;
  for (const auto& [seed, count] : early) {
    ended_early += static_cast<std::uint64_t>(count);
    least = std::min(least, count);
    most = std::max(most, count);
  }
  const auto drives = static_cast<double>(e.real_world.size())
                      / static_cast<double>(early.size()); // of a seed
  const auto share = share_interval(ended_early, e.real_world.size());
  const auto t_off = mean_t_off(all);
  const auto as_many = std::ranges::count_if(
      early, [](const auto& x) { return x.second >= paper::real_early_ends; });
  report::table t;
  t.title = "The real drives";
  t.columns = {"figure", "ours", "the paper"};
  t.rows = {
      {"latency, ms",
       fmt::format("{:.2f} ± {:.2f}", latency.mean, latency.deviation),
       fmt::format("{:.2f} ± {:.2f}", paper::real_latency_mean_ms,
                   paper::real_latency_deviation_ms)},
      {fmt::format("drives of {:.0f} that ended offloading early, mean (exact "
                   "95 % interval)",
                   drives),
       fmt::format("{:.2f} ({:.2f}–{:.2f})", drives * share.mean,
                   drives * share.low, drives * share.high),
       std::to_string(paper::real_early_ends)},
      {"the same, least and most of all seeds",
       fmt::format("{} and {}", least, most), "–"},
      {"seeds with at least two such drives",
       fmt::format("{} of {}", as_many, early.size()), "–"},
      {"seeds with such a drive", in_a_list(seeds_with_early_ends(all)), "–"},
      {"t_off per episode, s",
       t_off ? fmt::format("{:.1f} ({:.1f}–{:.1f})", t_off->mean, t_off->low,
                           t_off->high)
             : "–",
       "–"},
  };
  return t;
}

/// When each drive of the first seed was offloaded.
figure timelines(const paper_runs& e, const report_text& text) {
  constexpr auto gap = std::numeric_limits<double>::quiet_NaN();
  figure f;
  f.title = "The drives of seed 1";
  f.x_label = "time since the start, s";
  f.y_label = "drive";
  std::vector<std::pair<double, double>> early; // time, drive
  double number = 0;
  for (const auto& run : e.real_world) {
    if (run.point.seed != 1)
      continue;
    ++number;
    auto& offloaded = f.curves.emplace_back();
    offloaded.name = run.point.labels.at(0);
    for (const auto& episode : report::read_episodes(run.folder)) {
      if (!episode.by_requester || !episode.first_data_s)
        continue;
      for (const auto t : {*episode.first_data_s, episode.ended_s}) {
        offloaded.x.push_back(t);
        offloaded.y.push_back(number);
      }
      offloaded.x.push_back(episode.ended_s);
      offloaded.y.push_back(gap);
      if (episode.fallback)
        early.emplace_back(episode.ended_s, number);
    }
  }
  std::ranges::sort(early);
  curve ends;
  ends.name = "ended early";
  ends.drawn = curve::style::points;
  for (const auto& [t, drive] : early) {
    ends.x.push_back(t);
    ends.y.push_back(drive);
  }
  if (!early.empty())
    f.curves.push_back(std::move(ends));
  f.caption = text.fill("lines");
  return f;
}

histogram latencies(const paper_runs& e) {
  histogram all;
  for (const auto& run : e.real_world)
    all.add(read_histogram(run.folder, planning, "latency"));
  return all;
}

figure distribution_of(const histogram& latencies) {
  figure f;
  f.title = "Latency of the emulated drives";
  f.x_label = "ms";
  f.y_label = "share of results";
  f.curves.push_back(latencies.cumulative("all drives"));
  f.marks.emplace_back(paper::max_latency_ms, "l_max");
  return f;
}

std::string about_the_tail(const paper_runs& e, const histogram& latencies,
                           const report_text& text) {
  const auto late = latencies.share_above(paper::max_latency_ms);
  std::string here;
  if (late > 0)
    here = text.fill(
        "late_results",
        {{"one_in", fmt::format("{:.0f}", 1 / late)},
         {"l_max_ms", fmt::format("{}", paper::max_latency_ms)},
         {"results",
          fmt::format("{:.0f}",
                      static_cast<double>(latencies.count())
                          / static_cast<double>(e.real_world.size()))}});
  return text.fill("tail", {{"here", here},
                            {"paper_early", in_words(paper::real_early_ends)},
                            {"seeds", counted(early_ends(e).size(), "seed")}});
}

} // namespace

report::section real_world(const paper_runs& e) {
  const auto text = report_text::of("real_world");
  report::section s{"Real drives", {}};
  s.blocks.emplace_back(paragraph{text.fill(
      "emulation", {{"seeds", counted(early_ends(e).size(), "seed")}})});
  s.blocks.emplace_back(comparison(e));
  s.blocks.emplace_back(timelines(e, text));
  const auto all = latencies(e);
  s.blocks.emplace_back(distribution_of(all));
  s.blocks.emplace_back(paragraph{about_the_tail(e, all, text)});
  return s;
}

} // namespace sofof::experiments::study
