// Heights and rises of curves.
#include "experiments/dehler2025/curve_claims.hpp"

#include "base/options/units.hpp"
#include "experiments/dehler2025/area_time.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace sofof::experiments::study {

namespace {

constexpr double planning_period_ms = 50;

/// @returns the shortest limit at which t_off is half of `height`, ms.
double rise_ms(const paper_runs& e, const std::string& vehicles,
               double height) {
  double first = ms_of(longest_limit);
  for (const auto& gap : labels_of(e.latency_plot, 1)) {
    const auto t = mean_t_off(those(e.latency_plot, vehicles, gap));
    if (t && t->mean >= height / 2)
      first = std::min(first, ms_of(gap));
  }
  return first;
}

} // namespace

double ms_of(const std::string& duration_text) {
  return to_milliseconds(parse_duration(duration_text).value());
}

curve_claims claims_of(const paper_runs& e) {
  constexpr double near_share = 0.1, same_share = 0.01;
  curve_claims c;
  std::set<double> rises;
  std::vector<double> heights;
  const auto curves = labels_of(e.latency_plot, 0);
  for (const auto& n : curves)
    if (const auto top = mean_t_off(those(e.latency_plot, n, longest_limit))) {
      heights.push_back(top->mean);
      rises.insert(rise_ms(e, n, top->mean));
    }
  c.rises_ms.assign(rises.begin(), rises.end());
  c.rise_late = !curves.empty() && heights.size() == curves.size()
                && *rises.begin() > planning_period_ms;
  if (!heights.empty()) {
    const auto [low, high] = std::ranges::minmax(heights);
    c.heights_differ = high - low > same_share * high;
  }
  const auto one = mean_t_off(those(e.latency_plot, "1", longest_limit));
  const auto six = mean_t_off(those(e.latency_plot, "6", longest_limit));
  const auto stay = mean_time_in_area_s(those(e.in_area, 0, "1"));
  c.saturates =
      one && stay && std::abs(one->mean - *stay) <= near_share * *stay;
  c.six_lowest = six && std::ranges::count_if(heights, [&](double height) {
                          return height <= six->mean;
                        }) == 1;
  for (const auto* run : those(e.latency_plot, "6", longest_limit)) {
    c.early += run->ended_early;
    c.late += run->ended_late;
  }
  return c;
}

} // namespace sofof::experiments::study
