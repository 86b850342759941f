// Offloaded against local driving, seed by seed.
#include "experiments/dehler2025/deviation.hpp"
#include "experiments/dehler2025/report_text.hpp"
#include "experiments/dehler2025/sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace sofof::experiments::study {

namespace {

using report::paragraph;

double sum(std::span<const measured_run* const> runs, const std::string& name) {
  double all = 0;
  for (const auto* run : runs)
    all += run->figure(name);
  return all;
}

double largest(std::span<const measured_run* const> runs,
               const std::string& name) {
  double all = 0;
  for (const auto* run : runs)
    all = std::max(all, std::abs(run->figure(name)));
  return all;
}

report::table driving(const paper_runs& e) {
  const auto offloaded = those(e.quality, 0, "location");
  const auto local = those(e.quality, 0, "never");
  report::table t;
  t.title = "Driving, all seeds";
  t.columns = {"figure", "offloaded", "local"};
  const auto line = [&](const std::string& what, const auto& figure) {
    t.rows.push_back({what, figure(offloaded), figure(local)});
  };
  const auto largest_of = [&](const std::string& what, const char* name) {
    line(what, [name](const auto& runs) {
      return fmt::format("{:.2f}", largest(runs, name));
    });
  };
  const auto sum_of = [&](const std::string& what, const char* name) {
    line(what, [name](const auto& runs) {
      return fmt::format("{:.0f}", sum(runs, name));
    });
  };
  line("comfort cost, m²/s³ per km", [](const auto& runs) {
    constexpr double km = 1000;
    return fmt::format("{:.2f}", km * sum(runs, "driving.comfort_cost_m2ps3")
                                     / sum(runs, "driving.distance_m"));
  });
  largest_of("largest lateral acceleration, m/s²",
             "driving.max_lateral_accel_mps2");
  largest_of("largest jerk, m/s³", "driving.max_jerk_mps3");
  largest_of("hardest braking, m/s²", "driving.min_accel_mps2");
  sum_of("hard brakes", "driving.hard_brakes");
  sum_of("near misses", "safety.near_misses");
  sum_of("collisions", "safety.collisions");
  sum_of("emergency plans", "plans.emergency");
  line("mean speed, m/s", [](const auto& runs) {
    return fmt::format("{:.2f}", sum(runs, "driving.distance_m")
                                     / sum(runs, "safety.driven_s"));
  });
  return t;
}

report::table switches(const paper_runs& e, const report_text& text) {
  const auto runs = those(e.quality, 0, "location");
  report::table t;
  t.title = "Where the source of the plan changes";
  t.columns = {"jump of", "mean", "largest"};
  const auto count = sum(runs, "switch.count");
  const auto row = [&](const char* what, const std::string& name) {
    double weighted = 0;
    for (const auto* run : runs)
      weighted +=
          run->figure("switch.mean_" + name) * run->figure("switch.count");
    t.rows.push_back(
        {what, fmt::format("{:.6f}", weighted / count),
         fmt::format("{:.6f}", largest(runs, "switch.max_" + name))});
  };
  row("position, m", "d_m");
  row("curvature, 1/m", "kappa_1pm");
  row("speed, m/s", "v_mps");
  row("acceleration, m/s²", "a_mps2");
  t.note = text.fill("changes", {{"count", fmt::format("{:.0f}", count)}});
  return t;
}

report::table deviations(const paper_runs& e, const report_text& text) {
  report::table t;
  t.title = "How far the offloaded drive is from the local one";
  t.columns = {"seed", "path, rms, m", "path, largest, m", "speed, rms, m/s",
               "speed, largest, m/s"};
  const auto local = those(e.quality, 0, "never");
  for (const auto* run : those(e.quality, 0, "location")) {
    const auto other = std::ranges::find(
        local, run->point.seed, [](const auto* x) { return x->point.seed; });
    if (other == local.end())
      continue;
    const auto d = deviation_between(*run, **other);
    t.rows.push_back({std::to_string(run->point.seed),
                      fmt::format("{:.3f}", d.path_rms_m),
                      fmt::format("{:.3f}", d.path_max_m),
                      fmt::format("{:.3f}", d.speed_rms_mps),
                      fmt::format("{:.3f}", d.speed_max_mps)});
  }
  t.note = text.fill("places");
  return t;
}

} // namespace

report::section quality(const paper_runs& e) {
  const auto text = report_text::of("quality");
  const auto offloaded = those(e.quality, 0, "location");
  const auto vehicles =
      offloaded.empty() ? 0 : offloaded.front()->figure("vehicles");
  report::section s{"Quality of the offloaded result", {}};
  s.blocks.emplace_back(paragraph{text.fill(
      "question", {{"vehicles", counted(static_cast<std::uint64_t>(vehicles),
                                        "vehicle")}})});
  s.blocks.emplace_back(driving(e));
  s.blocks.emplace_back(switches(e, text));
  s.blocks.emplace_back(deviations(e, text));
  if (!offloaded.empty())
    s.blocks.emplace_back(report::drive{offloaded.front()->folder});
  return s;
}

} // namespace sofof::experiments::study
