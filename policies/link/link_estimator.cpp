// What to expect of a link: how late the next message, how long the next gap.
#include "policies/link/link_estimator.hpp"

#include <algorithm>
#include <cmath>

namespace sofof {

namespace {

constexpr double least_latency_s = 1e-6;
constexpr double longest_forecast_s = 86400;

duration forecast(double seconds) {
  return from_seconds(std::clamp(seconds, 0.0, longest_forecast_s));
}

} // namespace

link_estimator::link_estimator(const link_estimator_options& options)
    : options_{options}, log_latency_{options.alpha}, gap_s_{options.alpha} {}

void link_estimator::arrived(time_point created, time_point received) {
  if (last_ && received < *last_)
    return;
  const auto latency_s = to_seconds(received - created);
  log_latency_.add(std::log(std::max(latency_s, least_latency_s)));
  if (last_)
    gap_s_.add(to_seconds(received - *last_));
  last_ = received;
}

bool link_estimator::stale(time_point now) const {
  return !known()
         || to_seconds(now - *last_) > options_.stale_periods * gap_s_.mean();
}

double link_estimator::late_probability(duration limit, time_point now) const {
  if (stale(now))
    return 1;
  return log_latency_.probability_above(
      std::log(std::max(to_seconds(limit), least_latency_s)));
}

double link_estimator::gap_probability(duration limit, time_point now) const {
  if (stale(now))
    return 1;
  return gap_s_.probability_above(to_seconds(limit));
}

std::optional<duration> link_estimator::latency_quantile(double p) const {
  if (!known())
    return std::nullopt;
  return forecast(std::exp(log_latency_.quantile(p)));
}

std::optional<duration> link_estimator::gap_quantile(double p) const {
  if (!known())
    return std::nullopt;
  return forecast(gap_s_.quantile(p));
}

} // namespace sofof
