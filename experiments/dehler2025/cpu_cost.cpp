// The paper's table of computing time, and what it means.
#include "experiments/dehler2025/paper.hpp"
#include "experiments/dehler2025/sections.hpp"

#include <fmt/format.h>

namespace sofof::study {

namespace {

using report::paragraph;

std::string percent(std::optional<double> share) {
  return share ? fmt::format("{:.2f} %", 100 * *share) : "never";
}

std::vector<std::string> row(const std::string& whose, const cpu_shares& c) {
  return {whose,
          fmt::format("{:.3f}", c.active),
          fmt::format("{:.3f}", c.inactive),
          fmt::format("{:.3f}", c.requester),
          fmt::format("{:.3f}", c.requester_remote),
          percent(break_even_share(c))};
}

/// A planner as dear as the paper's, with our requester and our deactivation.
cpu_shares with_their_planner(cpu_shares ours, const cpu_shares& theirs) {
  ours.active = theirs.active - theirs.inactive + ours.inactive;
  return ours;
}

report::table shares(const paper_runs& e) {
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
  t.note = fmt::format(
      "The last column is the share of the time from which on a vehicle "
      "computes less than without offloading; with one c_SR for all times, "
      "as the paper has it, c_SR / (c_TPLa − c_TPLd). The paper prints {} % "
      "and {} %; its own table gives {} and {}.",
      paper::printed_share_20_hz, paper::printed_share_100_hz,
      percent(break_even_share(paper::cpu_20_hz)),
      percent(break_even_share(paper::cpu_100_hz)));
  return t;
}

report::table balance(const paper_runs& e) {
  report::table t;
  t.title = "With and without offloading, for the share of time of these runs";
  t.columns = {"at what rate", "vehicles",  "t_d / t_total",
               "c_without, %", "c_with, %", "measuring itself, %"};
  const auto add = [&t](const char* rate, const cpu_figures& c) {
    const auto offloaded = c.inactive_s / (c.active_s + c.inactive_s);
    t.rows.push_back(
        {rate, std::to_string(c.vehicles), percent(offloaded),
         fmt::format("{:.3f}", share_without_offloading(c.shares)),
         fmt::format("{:.3f}", share_with_offloading(c.shares, offloaded)),
         fmt::format("{:.3f}", c.overhead)});
  };
  add("20 Hz", e.cpu_20_hz.figures);
  add("100 Hz", e.cpu_100_hz.figures);
  t.note =
      "One run for each rate, so without an interval. What measuring takes "
      "is in the requester's share.";
  return t;
}

report::table energy(const paper_runs& e) {
  report::table t;
  t.title = "What that is in energy, J/km";
  t.columns = {"at what rate", "never offloaded", "a third of the time",
               "all the time"};
  const auto add = [&t](const char* rate, const measured_cpu& c) {
    constexpr double third = 1.0 / 3;
    const auto cell = [&c](double share) {
      return fmt::format("{:.3f}", energy_j_per_km(share, c.speed_mps));
    };
    const auto& shares = c.figures.shares;
    t.rows.push_back({rate, cell(share_without_offloading(shares)),
                      cell(share_with_offloading(shares, third)),
                      cell(share_with_offloading(shares, 1))});
  };
  add("20 Hz", e.cpu_20_hz);
  add("100 Hz", e.cpu_100_hz);
  t.note = fmt::format(
      "At the mean speeds of the runs, {:.1f} and {:.1f} m/s, with {:.2f} W "
      "for a busy core beyond an idle one: docs/results.md says whose figure "
      "that is.",
      e.cpu_20_hz.speed_mps, e.cpu_100_hz.speed_mps,
      core_power{}.more_when_busy_w());
  return t;
}

std::string verdict(const cpu_figures& c, const char* rate) {
  const auto share = break_even_share(c.shares);
  if (share && *share < 1)
    return fmt::format("At {} offloading pays from {} of the time on.", rate,
                       percent(share));
  return fmt::format("At {} offloading does not pay in computing time: our "
                     "planner takes {:.2f} % of a core, the requester "
                     "{:.3f} % while it is used.",
                     rate, c.shares.active, c.shares.requester_remote);
}

} // namespace

report::section cpu_cost(const paper_runs& e) {
  report::section s{"Computing time", {}};
  s.blocks.emplace_back(paragraph{
      "Wall-clock runs of 20 s at 20 Hz and at 100 Hz, with vehicles in the "
      "area for a part of the time. Each actor's computing time is read from "
      "its thread's clock around every turn. The planner's share includes "
      "its environment model; the requester's is that of SOFOF in the "
      "vehicle: offers, requests, the check of every result, decoding it and "
      "handing it on."});
  s.blocks.emplace_back(shares(e));
  s.blocks.emplace_back(balance(e));
  s.blocks.emplace_back(energy(e));
  s.blocks.emplace_back(paragraph{
      verdict(e.cpu_20_hz.figures, "20 Hz") + ' '
      + verdict(e.cpu_100_hz.figures, "100 Hz")
      + " The paper's planners are processes of ROS 2 that go on listening "
        "when they are deactivated; ours is an actor that keeps its newest "
        "input."});
  return s;
}

} // namespace sofof::study
