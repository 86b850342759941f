// Quantiles from a table, passes result by result.
#include "experiments/dehler2025/latency_model.hpp"

#include "base/random.hpp"
#include "experiments/dehler2025/paper.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace sofof::experiments::study {

namespace {

/// @returns the share of a standard Gaussian below z.
double gaussian_below(double z) {
  return std::erfc(-z / std::numbers::sqrt2) / 2;
}

/// Sums up the offloadings of one pass after another.
class offloadings {
public:
  explicit offloadings(const pass_model& pass) : pass_{pass} {}

  /// @param sent_ms  Since the begin of the pass.
  void on_result(double sent_ms, double latency_ms) {
    const auto at_ms = std::max(last_ms_, sent_ms + latency_ms);
    const auto late = at_ms - sent_ms > pass_.max_latency_ms;
    if (runs_ && at_ms - last_ms_ > pass_.max_interarrival_ms)
      end(last_ms_ + pass_.max_interarrival_ms);
    else if (runs_ && late)
      end(at_ms);
    else if (!runs_ && !late && sent_ms >= next_ms_) {
      runs_ = true;
      begun_ms_ = at_ms;
    }
    last_ms_ = at_ms;
  }

  void end_pass(double at_ms) {
    if (runs_)
      end(std::max(at_ms, begun_ms_));
    last_ms_ = next_ms_ = 0;
  }

  double mean_s() const { return count_ > 0 ? sum_ms_ / count_ / 1000 : 0; }

private:
  void end(double at_ms) {
    sum_ms_ += at_ms - begun_ms_;
    ++count_;
    runs_ = false;
    next_ms_ = at_ms + 1000 * pass_.pause_s;
  }

  const pass_model& pass_;
  bool runs_ = false;
  double begun_ms_ = 0;
  double last_ms_ = 0;
  double next_ms_ = 0;
  double sum_ms_ = 0;
  double count_ = 0;
};

} // namespace

bounded_latency::bounded_latency(double mean_ms, double deviation_ms,
                                 double longest_ms)
    : longest_ms_{longest_ms} {
  const auto mean = mean_ms / longest_ms;
  const auto variance = std::pow(deviation_ms / longest_ms, 2);
  const auto both = mean * (1 - mean) / variance - 1; // of the two shapes
  shape_ = mean * both;
  const auto other = both - shape_;
  assert(shape_ > 0 && other > 1);
  // In y = x^shape the density has no pole: (1 - y^(1/shape))^(other - 1).
  constexpr int steps = 200'000;
  const auto density = [&](int i) {
    return std::pow(1 - std::pow(static_cast<double>(i) / steps, 1 / shape_),
                    other - 1);
  };
  shares_.push_back(0);
  for (int i = 0; i < steps; ++i)
    shares_.push_back(shares_.back() + (density(i) + density(i + 1)) / 2);
  for (auto& share : shares_)
    share /= shares_.back();
}

double bounded_latency::quantile_ms(double share) const {
  const auto after = std::ranges::lower_bound(shares_, share);
  if (after == shares_.begin())
    return 0;
  if (after == shares_.end())
    return longest_ms_;
  const auto before = *(after - 1);
  const auto step = static_cast<double>(after - 1 - shares_.begin())
                    + (share - before) / (*after - before);
  const auto y = step / static_cast<double>(shares_.size() - 1);
  return longest_ms_ * std::pow(y, 1 / shape_);
}

double bounded_latency::share_above(double ms) const {
  if (ms >= longest_ms_)
    return 0;
  const auto y = std::pow(ms / longest_ms_, shape_);
  const auto place = y * static_cast<double>(shares_.size() - 1);
  const auto before = static_cast<std::size_t>(place);
  return 1
         - std::lerp(shares_[before], shares_[before + 1],
                     place - static_cast<double>(before));
}

double mean_t_off_s(const bounded_latency& law, const pass_model& pass) {
  constexpr std::uint64_t seed = 1;
  const random_stream noise{seed, "pass_model"};
  const auto results =
      static_cast<std::uint64_t>(1000 * pass.pass_s / pass.period_ms);
  const auto fresh = std::sqrt(1 - pass.correlation * pass.correlation);
  offloadings all{pass};
  for (std::uint64_t k = 0; k < pass.passes; ++k) {
    const auto draws = noise.part(k);
    auto z = draws.normal(0, 1, results);
    for (std::uint64_t i = 0; i < results; ++i) {
      all.on_result(static_cast<double>(i) * pass.period_ms,
                    law.quantile_ms(gaussian_below(z)));
      z = pass.correlation * z + fresh * draws.normal(0, 1, i);
    }
    all.end_pass(1000 * pass.pass_s);
  }
  return all.mean_s();
}

double share_of_drives_with_a_late_result(double least_ms, double limit_ms,
                                          double results) {
  // Computing LN(3, 1) ms, airtime exponential, 0.2 ms: docs/channels.md.
  constexpr double computing_ms = 3, computing_sd_ms = 1, airtime_ms = 0.2;
  const auto mean_ms =
      paper::real_latency_mean_ms - computing_ms - airtime_ms - least_ms;
  assert(mean_ms > 0);
  const auto variance = std::pow(paper::real_latency_deviation_ms, 2)
                        - std::pow(computing_sd_ms, 2)
                        - std::pow(airtime_ms, 2);
  const auto sigma = std::sqrt(std::log1p(variance / (mean_ms * mean_ms)));
  const auto mu = std::log(mean_ms) - sigma * sigma / 2;
  // The rest of the delay is drawn, the network's tail is not.
  constexpr std::uint64_t seed = 1, draws = 20'000;
  const random_stream noise{seed, "drive_model"};
  double late = 0;
  for (std::uint64_t i = 0; i < draws; ++i) {
    const auto left_ms = limit_ms - least_ms
                         - noise.lognormal(computing_ms, computing_sd_ms, i, 0)
                         - noise.exponential(airtime_ms, i, 7);
    late +=
        left_ms > 0 ? 1 - gaussian_below((std::log(left_ms) - mu) / sigma) : 1;
  }
  late /= static_cast<double>(draws);
  return -std::expm1(results * std::log1p(-late));
}

} // namespace sofof::experiments::study
