// The paper's table of computing time, and what it means.
#include "scenario/study/paper.hpp"
#include "scenario/study/sections.hpp"

#include <fmt/format.h>

namespace sofof::study {

namespace {

using report::paragraph;

/// Of the vehicles in the runs that are measured, about, m/s.
constexpr double mean_speed_mps = 8;

std::string percent(std::optional<double> share) {
  return share ? fmt::format("{:.2f} %", 100 * *share) : "never";
}

std::vector<std::string> row(const std::string& whose, const cpu_shares& c) {
  return {whose, fmt::format("{:.3f}", c.active),
          fmt::format("{:.3f}", c.inactive), fmt::format("{:.3f}", c.requester),
          percent(break_even_share(c))};
}

/// A planner as dear as the paper's, with our requester and our deactivation.
cpu_shares with_their_planner(const cpu_shares& ours,
                              const cpu_shares& theirs) {
  return {theirs.active - theirs.inactive + ours.inactive, ours.inactive,
          ours.requester};
}

report::table shares(const evidence& e) {
  report::table t;
  t.title = "Computing time in the vehicle, percent of one core";
  t.columns = {"who, at what rate", "planner active", "planner deactivated",
               "SOFOF requester", "offloading pays above"};
  t.rows.push_back(row("the paper, 20 Hz", paper::cpu_20_hz));
  if (e.cpu_20_hz)
    t.rows.push_back(row("ours, 20 Hz", e.cpu_20_hz->shares));
  t.rows.push_back(row("the paper, 100 Hz", paper::cpu_100_hz));
  if (e.cpu_100_hz)
    t.rows.push_back(row("ours, 100 Hz", e.cpu_100_hz->shares));
  if (e.cpu_20_hz)
    t.rows.push_back(
        row("our SOFOF, a planner of the paper's cost, 20 Hz",
            with_their_planner(e.cpu_20_hz->shares, paper::cpu_20_hz)));
  if (e.cpu_100_hz)
    t.rows.push_back(
        row("our SOFOF, a planner of the paper's cost, 100 Hz",
            with_their_planner(e.cpu_100_hz->shares, paper::cpu_100_hz)));
  t.note = fmt::format(
      "The last column is t_d / t_total > c_SR / (c_TPLa − c_TPLd). The paper "
      "prints {} % and {} %; its own table gives 8.73 % and 2.97 %.",
      paper::printed_share_20_hz, paper::printed_share_100_hz);
  return t;
}

report::table energy(const evidence& e) {
  report::table t;
  t.title = "What that is in energy, J/km";
  t.columns = {"at what rate", "never offloaded", "a third of the time",
               "all the time"};
  const auto add = [&t](const char* rate, const std::optional<cpu_figures>& c) {
    if (!c)
      return;
    constexpr double third = 1.0 / 3;
    const auto cell = [](double share) {
      return fmt::format("{:.3f}", energy_j_per_km(share, mean_speed_mps));
    };
    t.rows.push_back({rate, cell(share_without_offloading(c->shares)),
                      cell(share_with_offloading(c->shares, third)),
                      cell(share_with_offloading(c->shares, 1))});
  };
  add("20 Hz", e.cpu_20_hz);
  add("100 Hz", e.cpu_100_hz);
  t.note =
      fmt::format("At {} m/s, with {:.2f} W for a busy core beyond an idle "
                  "one; docs/results.md has the model.",
                  mean_speed_mps, core_power{}.more_when_busy_w());
  return t;
}

std::string verdict(const cpu_figures& c, const char* rate) {
  const auto share = break_even_share(c.shares);
  if (share && *share < 1)
    return fmt::format("At {} offloading pays from {} of the time on.", rate,
                       percent(share));
  return fmt::format("At {} offloading does not pay in computing time: our "
                     "planner takes {:.2f} "
                     "% of a core, the requester {:.3f} %.",
                     rate, c.shares.active, c.shares.requester);
}

} // namespace

report::section cpu_cost(const evidence& e) {
  report::section s{"Computing time", {}};
  s.blocks.emplace_back(paragraph{
      "Wall-clock runs of 20 s, six vehicles at 20 Hz and at 100 Hz, each "
      "about half of the time in the area. Each actor's computing time is read "
      "from its thread's clock around every turn. The planner's share includes "
      "its environment model; the requester's is that of SOFOF in the vehicle: "
      "offers, requests, the check of every result, decoding it and handing it "
      "on."});
  s.blocks.emplace_back(shares(e));
  s.blocks.emplace_back(energy(e));
  std::string text;
  if (e.cpu_20_hz)
    text += verdict(*e.cpu_20_hz, "20 Hz") + ' ';
  if (e.cpu_100_hz)
    text += verdict(*e.cpu_100_hz, "100 Hz") + ' ';
  s.blocks.emplace_back(paragraph{
      text
      + "The paper's planners are processes of ROS 2 that go on listening when "
        "they are deactivated; ours is an actor that keeps its newest input."});
  return s;
}

} // namespace sofof::study
