// Comparing a result's parts with those of the results before it.
#include "experiments/explain/cause.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

namespace sofof::experiments::explain {

namespace {

struct named_part {
  std::string_view what;
  double report::time_parts::*of;
  bool since_cycle; ///< It counts in the latency too.
};

constexpr std::array all_parts{
    named_part{"wait for the uplink", &report::time_parts::uplink_wait, false},
    named_part{"way up", &report::time_parts::uplink, false},
    named_part{"wait for the cycle", &report::time_parts::rest, false},
    named_part{"wait for a worker", &report::time_parts::queue, true},
    named_part{"computing", &report::time_parts::computing, true},
    named_part{"wait for the downlink", &report::time_parts::downlink_wait,
               true},
    named_part{"way down", &report::time_parts::downlink, true},
};

double median(std::vector<double> values) {
  if (values.empty())
    return 0;
  const auto middle =
      values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

} // namespace

bool counts_from_input(const report::cycle_line& x) {
  return x.latency_ms == x.input_age_ms;
}

part longest_part(std::span<const report::cycle_line> results,
                  bool since_input) {
  assert(!results.empty());
  const auto before = results.first(results.size() - 1);
  std::vector<part> parts;
  double all_ms = 0;
  for (const auto& x : all_parts) {
    if (!since_input && !x.since_cycle)
      continue;
    std::vector<double> usual;
    for (const auto& result : before)
      usual.push_back(result.parts.value().*x.of);
    parts.push_back(
        {x.what, results.back().parts.value().*x.of, median(std::move(usual))});
    all_ms += parts.back().ms;
  }
  const auto largest = *std::ranges::max_element(parts, {}, &part::ms);
  return largest.ms >= all_ms / 2
             ? largest
             : *std::ranges::max_element(parts, {}, &part::more_ms);
}

std::string in_parts(const report::time_parts& ms, bool since_input) {
  constexpr double least_ms = 0.05;
  constexpr std::size_t most = 3;
  std::vector<part> parts;
  double all_ms = 0;
  for (const auto& x : all_parts)
    if (since_input || x.since_cycle) {
      parts.push_back({x.what, ms.*x.of, 0});
      all_ms += parts.back().ms;
    }
  std::ranges::stable_sort(parts, std::ranges::greater{}, &part::ms);
  std::size_t named = 0;
  auto other_tenths = std::lround(10 * all_ms);
  for (; named < most && parts[named].ms >= least_ms; ++named) {
    const auto tenths = std::lround(10 * parts[named].ms);
    parts[named].ms = static_cast<double>(tenths) / 10;
    other_tenths -= tenths;
  }
  if (other_tenths < 0)
    parts.front().ms +=
        static_cast<double>(std::exchange(other_tenths, 0)) / 10;
  if (named > 0 && other_tenths > 0)
    parts[named++] = {"other", static_cast<double>(other_tenths) / 10, 0};
  std::string all;
  for (std::size_t k = 0; k < named; ++k)
    all += fmt::format("{}{} {:.1f}", k == 0 ? "" : ", ", parts[k].what,
                       parts[k].ms);
  return all;
}

} // namespace sofof::experiments::explain
