// Claims as a table, their tolerances beside them.
#include "experiments/dehler2025/verdicts.hpp"

#include "experiments/dehler2025/paper.hpp"
#include "experiments/dehler2025/report_text.hpp"

#include <fmt/format.h>

#include <map>

namespace sofof::experiments::study {

namespace {

std::string percent(double share) {
  return fmt::format("{:g}", 100 * share);
}

std::string plus_minus(double mean, double deviation) {
  return fmt::format("{:.2f} ± {:.2f}", mean, deviation);
}

named_figures costs(const recording::cpu_shares& theirs) {
  return {{"active", fmt::format("{}", theirs.active)},
          {"inactive", fmt::format("{}", theirs.inactive)},
          {"requester", fmt::format("{}", theirs.requester)},
          {"times", fmt::format("{}", tolerance::cost_times)}};
}

named_figures pays(const recording::cpu_shares& theirs, double printed) {
  const auto own = recording::break_even_share(theirs);
  return {{"printed", fmt::format("{}", printed)},
          {"own", fmt::format("{:.2f} %", 100 * own.value())},
          {"times", fmt::format("{}", tolerance::pays_times)}};
}

/// @returns the figures that the words of each claim have.
std::map<std::string, named_figures> figures_in_words() {
  const auto height = percent(tolerance::height);
  const auto fitted = percent(tolerance::fitted);
  return {
      {"rises", {{"times", fmt::format("{}", tolerance::rise_times)}}},
      {"saturates",
       {{"saturation_s", fmt::format("{}", paper::saturation_s)},
        {"percent", height},
        {"plateau_percent", percent(tolerance::plateau)}}},
      {"time_in_area", {{"percent", height}}},
      {"rises_slower",
       {{"from_percent", percent(tolerance::rising_from)},
        {"to_percent", percent(tolerance::rising_to)}}},
      {"six_lowest", {}},
      {"latency_grows", {{"percent", percent(tolerance::grown)}}},
      {"latency_of_one",
       {{"theirs",
         plus_minus(paper::latency_mean_ms, paper::latency_deviation_ms)},
        {"percent", fitted}}},
      {"nearly_all_in_time",
       {{"l_max_ms", fmt::format("{}", paper::max_latency_ms)},
        {"percent", percent(tolerance::few_late)}}},
      {"cost_20_hz", costs(paper::cpu_20_hz)},
      {"pays_20_hz", pays(paper::cpu_20_hz, paper::printed_share_20_hz)},
      {"v2x_negligible",
       {{"percent", fmt::format("{}", tolerance::little_v2x)}}},
      {"real_latency",
       {{"theirs", plus_minus(paper::real_latency_mean_ms,
                              paper::real_latency_deviation_ms)},
        {"percent", fitted}}},
      {"real_early_ends",
       {{"early", std::to_string(paper::real_early_ends)},
        {"drives", std::to_string(paper::real_drives)}}},
      {"switch_unnoticed",
       {{"speed_mps", fmt::format("{}", tolerance::quiet_jump_mps)},
        {"acceleration_mps2", fmt::format("{}", tolerance::quiet_jump_mps2)}}},
      {"cost_100_hz", costs(paper::cpu_100_hz)},
      {"pays_100_hz", pays(paper::cpu_100_hz, paper::printed_share_100_hz)}};
}

} // namespace

report::section verdicts(std::span<const judged_claim> claims) {
  const auto text = report_text::of("verdicts");
  const auto figures = figures_in_words();
  report::table t;
  t.title = "Claims that these runs measure";
  t.columns = {"claim", "verdict", "ours",
               "the paper, and when that counts as reproduced"};
  for (const auto& claim : claims)
    t.rows.push_back({claim.name, std::string{word_of(claim.word)}, claim.ours,
                      text.fill(claim.name, figures.at(claim.name))});
  t.note = text.fill("fitted");
  return {"Verdicts", {report::paragraph{text.fill("how")}, std::move(t)}};
}

} // namespace sofof::experiments::study
