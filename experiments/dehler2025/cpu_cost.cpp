// The paper's table of computing time, and what it means.
#include "experiments/dehler2025/paper.hpp"
#include "experiments/dehler2025/report_text.hpp"
#include "experiments/dehler2025/sections.hpp"

#include <fmt/format.h>

namespace sofof::experiments::study {

namespace {

using report::paragraph;

std::string percent(std::optional<double> share) {
  return share && *share < 1 ? fmt::format("{:.2f} %", 100 * *share) : "never";
}

std::vector<std::string> row(const std::string& whose,
                             const recording::cpu_shares& c) {
  return {whose,
          fmt::format("{:.3f}", c.active),
          fmt::format("{:.3f}", c.inactive),
          fmt::format("{:.3f}", c.requester),
          fmt::format("{:.3f}", c.requester_remote),
          percent(recording::break_even_share(c))};
}

/// A planner as dear as the paper's, with our requester and our deactivation.
recording::cpu_shares with_their_planner(recording::cpu_shares ours,
                                         const recording::cpu_shares& theirs) {
  ours.active = theirs.active - theirs.inactive + ours.inactive;
  return ours;
}

report::table shares(const paper_runs& e, const report_text& text) {
  report::table t;
  t.title = "Computing time in the vehicle, percent of one core";
  t.columns = {"who, at what rate",    "planner active",
               "planner deactivated",  "requester, local",
               "requester, offloaded", "offloading pays above"};
  t.rows.push_back(row("the paper, 20 Hz", paper::cpu_20_hz));
  t.rows.push_back(row("ours, 20 Hz", e.cpu_20_hz.figures.shares));
  t.rows.push_back(row("the paper, 100 Hz", paper::cpu_100_hz));
  t.rows.push_back(row("ours, 100 Hz", e.cpu_100_hz.figures.shares));
  t.rows.push_back(
      row("our SOFOF, a planner of the paper's cost, 20 Hz",
          with_their_planner(e.cpu_20_hz.figures.shares, paper::cpu_20_hz)));
  t.rows.push_back(
      row("our SOFOF, a planner of the paper's cost, 100 Hz",
          with_their_planner(e.cpu_100_hz.figures.shares, paper::cpu_100_hz)));
  t.note = text.fill(
      "break_even",
      {{"printed_20_hz", fmt::format("{}", paper::printed_share_20_hz)},
       {"printed_100_hz", fmt::format("{}", paper::printed_share_100_hz)},
       {"own_20_hz", percent(recording::break_even_share(paper::cpu_20_hz))},
       {"own_100_hz",
        percent(recording::break_even_share(paper::cpu_100_hz))}});
  return t;
}

report::table balance(const paper_runs& e, const report_text& text) {
  report::table t;
  t.title = "With and without offloading, for the share of time of these runs";
  t.columns = {
      "at what rate",    "vehicles",
      "t_d / t_total",   "c_without, %",
      "c_with, %",       "measuring itself, %",
      "V2X, at most, %", "offloading pays above, with all V2X as its cost"};
  const auto add = [&t](const char* rate, const measured_cpu& measured) {
    const auto& c = measured.figures;
    auto with_v2x = c.shares;
    with_v2x.requester += measured.v2x_at_most;
    with_v2x.requester_remote += measured.v2x_at_most;
    const auto offloaded = c.inactive_s / (c.active_s + c.inactive_s);
    t.rows.push_back(
        {rate, std::to_string(c.vehicles), percent(offloaded),
         fmt::format("{:.3f}", recording::share_without_offloading(c.shares)),
         fmt::format("{:.3f}",
                     recording::share_with_offloading(c.shares, offloaded)),
         fmt::format("{:.3f}", c.overhead),
         fmt::format("{:.3f}", measured.v2x_at_most),
         percent(recording::break_even_share(with_v2x))});
  };
  add("20 Hz", e.cpu_20_hz);
  add("100 Hz", e.cpu_100_hz);
  t.note = text.fill("balance");
  return t;
}

report::table energy(const paper_runs& e, const report_text& text) {
  report::table t;
  t.title = "What that is in energy, J/km";
  t.columns = {"at what rate", "never offloaded", "a third of the time",
               "all the time"};
  const auto add = [&t](const char* rate, const measured_cpu& c) {
    constexpr double third = 1.0 / 3;
    const auto cell = [&c](double share) {
      return fmt::format("{:.3f}",
                         recording::energy_j_per_km(share, c.speed_mps));
    };
    const auto& shares = c.figures.shares;
    t.rows.push_back({rate, cell(recording::share_without_offloading(shares)),
                      cell(recording::share_with_offloading(shares, third)),
                      cell(recording::share_with_offloading(shares, 1))});
  };
  add("20 Hz", e.cpu_20_hz);
  add("100 Hz", e.cpu_100_hz);
  t.note = text.fill(
      "energy",
      {{"speed_20_hz", fmt::format("{:.1f}", e.cpu_20_hz.speed_mps)},
       {"speed_100_hz", fmt::format("{:.1f}", e.cpu_100_hz.speed_mps)},
       {"core_w",
        fmt::format("{:.2f}", recording::core_power{}.more_when_busy_w())}});
  return t;
}

std::string whether_it_pays(const recording::cpu_figures& c, const char* rate,
                            const report_text& text) {
  const auto share = recording::break_even_share(c.shares);
  if (share && *share < 1)
    return text.fill("pays", {{"rate", rate}, {"share", percent(share)}});
  return text.fill(
      "does_not_pay",
      {{"rate", rate},
       {"planner", fmt::format("{:.2f}", c.shares.active)},
       {"requester", fmt::format("{:.3f}", c.shares.requester_remote)}});
}

} // namespace

report::section cpu_cost(const paper_runs& e) {
  const auto text = report_text::of("cpu_cost");
  report::section s{"Computing time", {}};
  s.blocks.emplace_back(paragraph{
      text.fill("measurement",
                {{"runs", std::to_string(e.cpu_20_hz.runs.size())},
                 {"length_s", fmt::format("{:.0f}", e.cpu_20_hz.length_s)}})});
  s.blocks.emplace_back(shares(e, text));
  s.blocks.emplace_back(balance(e, text));
  s.blocks.emplace_back(energy(e, text));
  s.blocks.emplace_back(
      paragraph{whether_it_pays(e.cpu_20_hz.figures, "20 Hz", text) + ' '
                + whether_it_pays(e.cpu_100_hz.figures, "100 Hz", text) + ' '
                + text.fill("planners")});
  return s;
}

} // namespace sofof::experiments::study
