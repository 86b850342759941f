// What the headlines hang on: tails, correlation, workers, least delays.
#include "experiments/dehler2025/latency_model.hpp"
#include "experiments/dehler2025/mean_interval.hpp"
#include "experiments/dehler2025/offloading_time.hpp"
#include "experiments/dehler2025/paper.hpp"
#include "experiments/dehler2025/report_text.hpp"
#include "experiments/dehler2025/sections.hpp"
#include "experiments/dehler2025/t_off_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace sofof::experiments::study {

namespace {

constexpr double limits_ms[] = {50, 60, 70, 80, 90, 100, 120, 150};

bounded_latency law_to(double longest_ms) {
  return {paper::latency_mean_ms, paper::latency_deviation_ms, longest_ms};
}

report::curve model_curve(std::string name, const bounded_latency& law,
                          pass_model pass) {
  report::curve c;
  c.name = std::move(name);
  for (const auto limit : limits_ms) {
    pass.max_interarrival_ms = limit;
    c.x.push_back(limit);
    c.y.push_back(mean_t_off_s(law, pass));
  }
  return c;
}

report::figure plot_of_t_off(const char* title) {
  report::figure f;
  f.title = title;
  f.x_label = "Δt_max, ms";
  f.y_label = "t_off, s";
  f.marks.emplace_back(paper::max_interarrival_ms, "the paper's choice");
  return f;
}

report::figure tails(const report_text& text) {
  auto f = plot_of_t_off("Where the tail ends");
  for (const double longest_ms : {45, 49, 52, 55, 60, 500}) {
    const auto law = law_to(longest_ms);
    f.curves.push_back(
        model_curve(fmt::format("{} ms ({:.4f} % late)", longest_ms,
                                100 * law.share_above(paper::max_latency_ms)),
                    law, {}));
  }
  f.caption = text.fill(
      "tail", {{"pass_s", fmt::format("{}", pass_model{}.pass_s)},
               {"latency_ms", fmt::format("{} ± {}", paper::latency_mean_ms,
                                          paper::latency_deviation_ms)},
               {"l_max_ms", fmt::format("{}", paper::max_latency_ms)}});
  return f;
}

report::figure correlations(const report_text& text) {
  auto f = plot_of_t_off("Latencies that depend on the one before");
  const auto law = law_to(45);
  for (const double correlation : {0.0, 0.5, 0.9, 0.99}) {
    pass_model pass;
    pass.correlation = correlation;
    f.curves.push_back(
        model_curve(fmt::format("correlation {}", correlation), law, pass));
  }
  f.caption = text.fill("correlation");
  return f;
}

/// Curves of other runs, those of the latency plot dashed beside them.
report::figure curves_beside(const paper_runs& e,
                             std::span<const measured_run> runs,
                             const char* title, std::string caption) {
  auto f = t_off_figure(title);
  for (const auto& n : labels_of(runs, 0))
    f.curves.push_back(t_off_curve(runs, n, count_of_vehicles(n)));
  for (const auto* n : {"1", "6"}) {
    f.curves.push_back(t_off_curve(e.latency_plot, n,
                                   count_of_vehicles(n) + ", latency plot"));
    f.curves.back().dashed = true;
  }
  f.caption = std::move(caption);
  return f;
}

report::figure correlated(const paper_runs& e, const report_text& text) {
  const auto latency = pooled(those(e.correlated, 0, "1"), "latency_ms");
  return curves_beside(
      e, e.correlated, "Latencies that depend on the one before, simulated",
      text.fill("correlated",
                {{"latency_ms", fmt::format("{:.2f} ± {:.2f}", latency.mean,
                                            latency.deviation)}}));
}

report::figure loaded_host(const paper_runs& e, const report_text& text) {
  const auto latency = [&e](const char* n) {
    const auto x = pooled(those(e.loaded_host, 0, n), "latency_ms");
    return fmt::format("{:.2f} ± {:.2f}", x.mean, x.deviation);
  };
  return curves_beside(e, e.loaded_host, "One host for all vehicles' software",
                       text.fill("loaded_host", {{"one_ms", latency("1")},
                                                 {"six_ms", latency("6")}}));
}

report::table hosts(const paper_runs& e, const report_text& text) {
  report::table t;
  t.title = "The host at the edge server";
  t.columns = {"host", "vehicles", "t_off, s", "early ends per hour",
               "latency, ms"};
  const auto with_interval = [](const std::optional<interval>& x) {
    return x ? fmt::format("{:.1f} ({:.1f}–{:.1f})", x->mean, x->low, x->high)
             : "–";
  };
  std::size_t most = 0;
  for (const auto& host : labels_of(e.host, 1))
    for (const auto& n : labels_of(e.host, 0)) {
      const auto runs = those(e.host, n, host);
      most = std::max(most, runs.size());
      const auto latency = pooled(runs, "latency_ms");
      t.rows.push_back(
          {host, n, with_interval(mean_t_off(runs)),
           with_interval(early_ends_per_hour(runs)),
           fmt::format("{:.2f} ± {:.2f}", latency.mean, latency.deviation)});
    }
  t.note = text.fill("host", {{"runs", counted(most, "run")}});
  return t;
}

/// @returns the mean number of results of a real drive.
double results_of_a_drive(const paper_runs& e) {
  double all = 0;
  for (const auto& run : e.real_world)
    all += run.figure("latency_ms.count");
  return all
         / static_cast<double>(std::max<std::size_t>(1, e.real_world.size()));
}

report::figure least_delays(const paper_runs& e, const report_text& text) {
  const auto results = results_of_a_drive(e);
  report::figure f;
  f.title = "The least delay of the real drives' channel";
  f.x_label = "least delay of the network, ms";
  f.y_label = "drives of 15 that end early";
  report::curve ours;
  ours.name = "the same mean and deviation";
  for (const double least_ms : {2, 3, 4, 5, 6, 7, 8}) {
    ours.x.push_back(least_ms);
    ours.y.push_back(paper::real_drives
                     * share_of_drives_with_a_late_result(
                         least_ms, paper::max_latency_ms, results));
  }
  f.curves.push_back(std::move(ours));
  f.levels.emplace_back(paper::real_early_ends, "the paper");
  f.marks.emplace_back(5, "paper_5g");
  f.caption = text.fill(
      "least_delay",
      {{"l_max_ms", fmt::format("{}", paper::max_latency_ms)},
       {"results", fmt::format("{:.0f}", results)},
       {"latency_ms", fmt::format("{} ± {}", paper::real_latency_mean_ms,
                                  paper::real_latency_deviation_ms)},
       {"early", std::to_string(paper::real_early_ends)}});
  return f;
}

} // namespace

report::section sensitivity(const paper_runs& e) {
  const auto text = report_text::of("sensitivity");
  return {"What the headlines hang on",
          {report::paragraph{text.fill("why")}, tails(text), correlations(text),
           correlated(e, text), hosts(e, text), loaded_host(e, text),
           least_delays(e, text)}};
}

} // namespace sofof::experiments::study
