// How often policies say no, and what that changes.
#include "base/input_error.hpp"
#include "experiments/dehler2025/offloading_time.hpp"
#include "experiments/dehler2025/report_text.hpp"
#include "experiments/dehler2025/sections.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sofof::experiments::study {

namespace {

/// Decisions of some runs together, and what came of them.
struct decisions {
  double offers = 0; ///< The LODM decides on each,
  double requests = 0;
  double refused = 0; ///< and the CODM on each request.
  double offloaded_share = 0;
  double runs = 0;

  /// @param outside  Offers to vehicles outside r_off.
  double lodm_no(double outside) const {
    return share(offers - outside - requests, offers - outside);
  }
  double codm_no() const { return share(refused, requests); }

private:
  static double share(double part, double all) {
    return all > 0 ? part / all : 0;
  }
};

decisions decisions_in(std::span<const measured_run* const> runs) {
  decisions all;
  for (const auto* run : runs) {
    all.offers += run->figure("offers");
    all.requests += run->figure("requests");
    all.refused += run->figure("rejected");
    all.offloaded_share += run->figure("offloaded_share");
    ++all.runs;
  }
  return all;
}

/// The line by which offers out of reach are known: all that the LODM refuses
/// in it.
const std::string nothing_required = "none";

/// @param outside  Offers to vehicles outside r_off.
std::vector<std::string> row_of(const std::string& requirements,
                                const decisions& d,
                                const std::optional<interval>& t_off,
                                double outside) {
  return {requirements,
          fmt::format("{:.0f}", d.offers),
          fmt::format("{:.0f}", d.offers - outside),
          requirements == nothing_required
              ? "–"
              : fmt::format("{:.1f} %", 100 * d.lodm_no(outside)),
          fmt::format("{:.0f}", d.requests),
          fmt::format("{:.1f} %", 100 * d.codm_no()),
          fmt::format("{:.0f}", d.requests - d.refused),
          t_off ? fmt::format("{:.2f} ({:.2f}–{:.2f})", t_off->mean, t_off->low,
                              t_off->high)
                : "–",
          fmt::format("{:.1f} %", 100 * d.offloaded_share / d.runs)};
}

} // namespace

report::section refusals(const paper_runs& e) {
  const auto text = report_text::of("refusals");
  report::table t;
  t.title = "Decisions, and what they change";
  constexpr std::size_t offloadings = 6, t_off_s = 7, time_share = 8;
  t.columns = {"t_min, d_min", "offers",   "of them taken as within r_off",
               "LODM says no", "requests", "CODM says no",
               "offloadings",  "t_off, s", "share of the time offloaded"};
  report::figure f;
  f.title = "Requirements and refusals";
  f.x_label = "requirements, in the order of the table";
  f.y_label = "share";
  report::curve lodm, codm, offloaded;
  lodm.name = "of offers within r_off, the LODM refuses";
  codm.name = "of requests, the CODM refuses";
  offloaded.name = "of the time, offloaded";
  const auto free = decisions_in(those(e.refusals, 0, nothing_required));
  const auto outside = free.offers - free.requests;
  if (!e.refusals.empty() && free.runs == 0)
    throw input_error{fmt::format("the study of refusals has no line \"{}\", "
                                  "by which offers out of reach "
                                  "are known; add it to refusals.toml.",
                                  nothing_required)};
  double number = 0;
  for (const auto& requirements : labels_of(e.refusals, 0)) {
    const auto runs = those(e.refusals, 0, requirements);
    const auto d = decisions_in(runs);
    t.rows.push_back(row_of(requirements, d, mean_t_off(runs), outside));
    ++number;
    for (auto* c : {&codm, &offloaded})
      c->x.push_back(number);
    if (requirements != nothing_required) {
      lodm.x.push_back(number);
      lodm.y.push_back(d.lodm_no(outside));
    }
    codm.y.push_back(d.codm_no());
    offloaded.y.push_back(d.offloaded_share / d.runs);
  }
  f.curves = {lodm, codm, offloaded};
  std::string answer;
  if (!t.rows.empty()) {
    const auto& first = t.rows.front();
    const auto& last = t.rows.back();
    answer = text.fill("answer", {{"offloadings", first[offloadings]},
                                  {"fewer", last[offloadings]},
                                  {"t_off_s", first[t_off_s]},
                                  {"other_t_off_s", last[t_off_s]},
                                  {"share", first[time_share]},
                                  {"less", last[time_share]}});
  }
  return {"When the policies say no",
          {report::paragraph{text.fill("question")}, std::move(t), std::move(f),
           report::paragraph{answer}}};
}

} // namespace sofof::experiments::study
