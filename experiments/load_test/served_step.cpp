// How late each cycle began, by its number.
#include "experiments/load_test/served_step.hpp"

#include <algorithm>
#include <cassert>
#include <map>
#include <optional>
#include <set>

namespace sofof::experiments::load_test {

namespace {

constexpr double per_ms = 1e-3;

/// When a cycle began after the begin of the period of its number, s.
double offset_s(const report::cycle_line& x, double period_s) {
  const auto began_s = x.received_s - per_ms * x.latency_ms;
  return began_s - period_s * static_cast<double>(x.cycle);
}

} // namespace

void count_results(std::span<const report::cycle_line> lines,
                   const counted_window& window, served_step& to) {
  assert(window.period > duration{0});
  const auto period_s = to_seconds(window.period);
  const auto counts = [&window](const report::cycle_line& x) {
    return x.received_s >= window.from_s && x.received_s < window.until_s;
  };
  struct session {
    double least_offset_s = 0;
    std::optional<std::uint64_t> last{}; // cycle
  };
  std::map<report::session_key, session> sessions;
  for (const auto& x : lines)
    if (counts(x)) {
      const auto at_s = offset_s(x, period_s);
      const auto [known, is_new] = sessions.try_emplace(x.of, session{at_s});
      if (!is_new)
        known->second.least_offset_s =
            std::min(known->second.least_offset_s, at_s);
    }
  std::set<std::uint64_t> stations;
  for (const auto& x : lines) {
    if (!counts(x))
      continue;
    auto& of = sessions.at(x.of);
    const auto late_s = offset_s(x, period_s) - of.least_offset_s;
    assert(late_s >= 0);
    if (of.last)
      for (auto missing = *of.last + 1; missing < x.cycle; ++missing)
        to.response.add(window.period);
    of.last = x.cycle;
    const auto computing_ms = x.parts ? x.parts->queue + x.parts->computing : 0;
    to.response.add(from_seconds(late_s + per_ms * computing_ms));
    to.latency.add(from_seconds(per_ms * x.latency_ms));
    stations.insert(x.of.station);
    ++to.results;
  }
  to.served = stations.size();
  to.measured_s = window.until_s - window.from_s;
  to.due = static_cast<std::uint64_t>(static_cast<double>(to.vehicles)
                                      * to.measured_s / period_s);
}

} // namespace sofof::experiments::load_test
