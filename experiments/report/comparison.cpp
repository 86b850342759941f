// Totals per minute, extremes with care, means as they are.
#include "experiments/report/comparison.hpp"

#include "experiments/report/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

namespace sofof::experiments::report {

namespace {

constexpr double no_longer = 0.01;     // a share of the longer run
constexpr double worth_a_word = 0.01;  // a share of the larger figure
constexpr double no_difference = 1e-9; // no more than rounding

std::string_view last_part(std::string_view member) {
  return member.substr(member.rfind('.') + 1); // npos + 1 is 0
}

enum class wish { none, less, more };

/// Of figures of which everybody wants less, or more; the first that fits.
constexpr std::pair<std::string_view, wish> wishes[]{
    {"latency_ms.count", wish::none},
    {"interarrival_ms.count", wish::none},
    {"latency_ms.", wish::less},
    {"input_age_ms.", wish::less},
    {"interarrival_ms.", wish::less},
    {"no_data", wish::less},
    {"fallbacks", wish::less},
    {"implausible.", wish::less},
    {"ended_by.qos_", wish::less},
    {"ended_by.implausible", wish::less},
    {"ended_by.no_data", wish::less},
    {"ended_by.cam_timeout", wish::less},
    {"ended_by.peer_lost", wish::less},
    {"t_off_s.", wish::more},
    {"offloaded_share", wish::more},
    {"safety.", wish::less},
    {"plans.emergency", wish::less},
    {"plans.safe_stops", wish::less},
    {"driving.min_accel", wish::more},
    {"driving.max_", wish::less},
    {"driving.hard_brakes", wish::less},
    {"driving.comfort_cost", wish::less},
    {"energy.per_km", wish::less},
    {"energy.saved", wish::more},
    {"switch.max_", wish::less},
    {"traffic.arrived", wish::more},
    {"traffic.", wish::less},
};

wish wish_for(std::string_view member) {
  for (const auto& [begins, wanted] : wishes)
    if (member.starts_with(begins))
      return wanted;
  return wish::none;
}

/// @returns whether a figure is one of results that came.
bool is_of_results(std::string_view member) {
  constexpr std::string_view all[]{"latency_ms.", "input_age_ms.",
                                   "interarrival_ms."};
  return std::ranges::any_of(
      all, [member](auto begins) { return member.starts_with(begins); });
}

double length_min(const recorded_run& run) {
  constexpr double s_per_min = 60;
  return run.figure("virtual_s").value_or(0) / s_per_min;
}

/// @returns a difference with its sign: what would round to 0 and is not, with
/// its first digit.
std::string signed_text(double x, int decimals) {
  auto text = fmt::format("{:+.{}f}", x, decimals);
  if (text.find_first_of("123456789") != text.npos)
    return text;
  return std::abs(x) < no_difference ? "0" : fmt::format("{:+.1g}", x);
}

void warn_of_unlike_lengths(section& to, std::span<const recorded_run> runs) {
  if (runs.size() != 2 || !comparison{runs}.unlike_lengths())
    return;
  constexpr double s_per_min = 60;
  to.blocks.emplace_back(paragraph{fmt::format(
      "`{}` lasted {:.0f} s, `{}` {:.0f} s: differences of counts are per "
      "minute, and largest and lowest values, which a longer run has more "
      "time to reach, are not subtracted.",
      runs[0].label, length_min(runs[0]) * s_per_min, runs[1].label,
      length_min(runs[1]) * s_per_min)});
}

void warn_of_early_ends(section& to, std::span<const recorded_run> runs) {
  if (runs.size() == 2 && comparison{runs}.cuts_off())
    to.blocks.emplace_back(paragraph{
        "Episodes ended early. What would have come after that is in no figure "
        "of results: where more end early, latency, age and gaps of the others "
        "look better, and are not judged."});
}

void warn_of_seeds(section& to, std::span<const recorded_run> runs) {
  const auto other = [&runs](const recorded_run& x) {
    return x.what.seed != runs[0].what.seed;
  };
  if (std::ranges::any_of(runs, other))
    to.blocks.emplace_back(
        paragraph{"The seeds differ: a part of every difference is chance."});
}

} // namespace

figure_nature nature_of(std::string_view member) {
  constexpr std::string_view means[]{
      "mean",        "std",         "p50",      "p95",
      "p99",         "fairness",    "vehicles", "offloaded_share",
      "saved_share", "x_real_time", "per_km_j", "mean_octets"};
  const auto last = last_part(member);
  if (last == "max" || last.starts_with("max_") || last.starts_with("min_"))
    return figure_nature::extreme;
  if (last.starts_with("mean_")
      || std::ranges::find(means, last) != std::end(means))
    return figure_nature::mean;
  return figure_nature::total;
}

comparison::comparison(std::span<const recorded_run> runs)
    : first_min_{length_min(runs[0])}, second_min_{length_min(runs[1])},
      unlike_{std::abs(first_min_ - second_min_)
              > no_longer * std::max(first_min_, second_min_)},
      cuts_off_{std::ranges::any_of(runs, [](const recorded_run& run) {
        return run.figure("fallbacks").value_or(0) > 0;
      })} {}

double comparison::of_first(std::string_view member, double x) const {
  const auto is_rate = unlike_ && nature_of(member) == figure_nature::total;
  return is_rate ? x / first_min_ : x;
}

double comparison::of_second(std::string_view member, double x) const {
  const auto is_rate = unlike_ && nature_of(member) == figure_nature::total;
  return is_rate ? x / second_min_ : x;
}

std::string comparison::difference(std::string_view member, double first,
                                   double second, int decimals) const {
  if (!unlike_)
    return signed_text(second - first, decimals);
  const auto nature = nature_of(member);
  if (nature == figure_nature::mean)
    return signed_text(second - first, decimals);
  if (nature == figure_nature::extreme || member == "virtual_s"
      || first_min_ <= 0 || second_min_ <= 0)
    return "–";
  constexpr int least_decimals = 2; // a count has none, a rate has
  auto text = signed_text(of_second(member, second) - of_first(member, first),
                          std::max(decimals, least_decimals));
  return text == "0" ? text : text + " /min";
}

table::verdict comparison::verdict(std::string_view member, double first,
                                   double second) const {
  if ((unlike_ && nature_of(member) == figure_nature::extreme)
      || (cuts_off_ && is_of_results(member)))
    return table::verdict::different;
  const auto before = of_first(member, first);
  const auto after = of_second(member, second);
  const auto more = after - before;
  const auto wanted = wish_for(member);
  if (wanted == wish::none
      || std::abs(more)
             <= worth_a_word * std::max(std::abs(before), std::abs(after)))
    return table::verdict::different;
  return (more < 0) == (wanted == wish::less) ? table::verdict::better
                                              : table::verdict::worse;
}

section what_differs(std::span<const recorded_run> runs) {
  section all{.title = "What differs", .blocks = {}};
  std::vector<std::string_view> texts;
  for (const auto& run : runs)
    texts.push_back(run.config_toml);
  auto options = differing_options(texts);
  warn_of_unlike_lengths(all, runs);
  warn_of_early_ends(all, runs);
  warn_of_seeds(all, runs);
  if (options.rows.empty()) {
    all.blocks.emplace_back(paragraph{"The runs have the same configuration."});
    return all;
  }
  options.title = "Options that differ";
  options.columns = {"option"};
  for (const auto& run : runs)
    options.columns.push_back(run.label);
  all.blocks.emplace_back(std::move(options));
  return all;
}

std::string difference_in_short(const table& options) {
  constexpr std::size_t most = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(options.rows.size(), most); ++i) {
    const auto& row = options.rows[i];
    text += fmt::format("{}{} {}", text.empty() ? "" : "; ", row[0], row[1]);
    for (std::size_t k = 2; k < row.size(); ++k)
      text += " → " + row[k];
  }
  if (options.rows.size() > most)
    text += fmt::format("; {} more", options.rows.size() - most);
  return text;
}

} // namespace sofof::experiments::report
