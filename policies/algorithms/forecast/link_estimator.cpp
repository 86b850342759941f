// What to expect of a link: how late the next message, how long the next gap.
#include "policies/algorithms/forecast/link_estimator.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::policies {

namespace {

constexpr double least_latency_s = 1e-6;
constexpr double longest_forecast_s = 86400;

duration forecast(double seconds) {
  return from_seconds(std::clamp(seconds, 0.0, longest_forecast_s));
}

} // namespace

link_estimator::link_estimator(const link_estimator_options& options)
    : options_{options}, log_latency_{options.alpha}, gap_s_{options.alpha},
      answer_gap_s_{options.alpha} {
  assert(options.least_count >= 2 && options.most_missed >= 1);
}

void link_estimator::arrived(time_point created, time_point received) {
  if (last_ && received < *last_)
    return;
  learn(created, received, 1);
  // What was silent for long has begun anew.
  if (last_result_ && last_result_ >= last_answer_)
    gap_s_.add(to_seconds(received - *last_result_));
  last_result_ = received;
}

void link_estimator::answered(time_point created, time_point received) {
  if (last_ && received < *last_)
    return;
  const auto missed =
      last_ ? to_seconds(received - *last_) / to_seconds(options_.period) : 1;
  learn(created, received, std::clamp(missed, 1.0, options_.most_missed));
  if (last_answer_ && last_answer_ >= last_result_)
    answer_gap_s_.add(to_seconds(received - *last_answer_));
  last_answer_ = received;
}

void link_estimator::learn(time_point created, time_point received,
                           double times) {
  const auto latency_s = to_seconds(received - created);
  log_latency_.add(std::log(std::max(latency_s, least_latency_s)), times);
  last_ = received;
}

bool link_estimator::stale(time_point now) const {
  if (!known())
    return true;
  const auto silent_s = to_seconds(now - *last_);
  const auto& gaps = last_result_ >= last_answer_ ? gap_s_ : answer_gap_s_;
  return gaps.count() > 0 && silent_s > options_.stale_periods * gaps.mean();
}

double link_estimator::late_probability(duration limit, time_point now) const {
  if (stale(now))
    return 1;
  return log_latency_.probability_above(
      std::log(std::max(to_seconds(limit), least_latency_s)));
}

double link_estimator::gap_probability(duration limit, time_point now) const {
  if (stale(now) || gap_s_.count() == 0)
    return 1;
  return gap_s_.probability_above(to_seconds(limit));
}

std::optional<duration> link_estimator::latency_quantile(double p) const {
  assert(p > 0 && p < 1);
  if (!known())
    return std::nullopt;
  return forecast(std::exp(log_latency_.quantile(p)));
}

std::optional<duration> link_estimator::gap_quantile(double p) const {
  assert(p > 0 && p < 1);
  if (!known() || gap_s_.count() == 0)
    return std::nullopt;
  return forecast(gap_s_.quantile(p));
}

} // namespace sofof::policies
