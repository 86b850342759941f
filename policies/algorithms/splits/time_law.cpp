// A sum of independent times is distributed by the convolution of their laws.
#include "policies/algorithms/splits/time_law.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::policies {

namespace {

std::size_t step_of(duration d) {
  const auto nearest =
      (std::max(d, duration{0}) + time_law::step / 2) / time_law::step;
  return std::min(static_cast<std::size_t>(nearest), time_law::most_steps);
}

} // namespace

time_law time_law::exactly(duration d) {
  time_law x;
  x.add(d);
  return x;
}

time_law time_law::uniform(duration longest) {
  assert(longest >= duration{0});
  time_law x;
  const auto last = step_of(longest);
  x.weights_.assign(last + 1, 1.0);
  if (last > 0)
    x.weights_.front() = x.weights_.back() = 0.5;
  x.count_ = last > 0 ? static_cast<double>(last) : 1;
  return x;
}

time_law time_law::normal(duration mean, duration deviation, duration longest) {
  if (deviation <= duration{0})
    return exactly(std::clamp(mean, duration{0}, longest));
  const auto below = [&](duration t) {
    const auto z = to_seconds(t - mean) / to_seconds(deviation);
    return std::erfc(-z / std::sqrt(2.0)) / 2;
  };
  time_law x;
  const auto last = step_of(longest);
  x.weights_.resize(last + 1);
  x.count_ = 1;
  double sum = 0;
  for (std::size_t k = 0; k < last; ++k) {
    const auto until = below(static_cast<duration::rep>(k) * step + step / 2);
    x.weights_[k] = until - sum;
    sum = until;
  }
  x.weights_[last] = 1 - sum;
  return x;
}

void time_law::add(duration d) {
  const auto k = step_of(d);
  if (weights_.size() <= k)
    weights_.resize(k + 1);
  weights_[k] += 1;
  count_ += 1;
}

std::optional<duration> time_law::mean() const {
  if (!is_known())
    return std::nullopt;
  double sum = 0;
  for (std::size_t k = 0; k < weights_.size(); ++k)
    sum += static_cast<double>(k) * weights_[k];
  return from_seconds(sum / count_ * to_seconds(step));
}

std::optional<duration> time_law::quantile(double p) const {
  assert(p > 0 && p <= 1);
  if (!is_known())
    return std::nullopt;
  constexpr double rounding = 1e-9;
  const auto wanted = p * count_ * (1 - rounding);
  double sum = 0;
  for (std::size_t k = 0; k < weights_.size(); ++k) {
    sum += weights_[k];
    if (sum >= wanted)
      return static_cast<duration::rep>(k) * step;
  }
  return static_cast<duration::rep>(weights_.size() - 1) * step;
}

time_law after(const time_law& x, const time_law& y) {
  if (!x.is_known() || !y.is_known())
    return {};
  constexpr auto most = time_law::most_steps;
  time_law sum;
  sum.weights_.resize(
      std::min(x.weights_.size() + y.weights_.size() - 1, most + 1));
  for (std::size_t i = 0; i < x.weights_.size(); ++i)
    if (x.weights_[i] > 0)
      for (std::size_t j = 0; j < y.weights_.size(); ++j)
        sum.weights_[std::min(i + j, most)] +=
            x.weights_[i] / x.count_ * y.weights_[j] / y.count_;
  sum.count_ = 1;
  return sum;
}

// Of the times that count as a multiple, half are a little longer.
time_law until_multiple_of(duration period, const time_law& x) {
  assert(period > duration{0} && period % time_law::step == duration{0});
  const auto every = static_cast<std::size_t>(period / time_law::step);
  time_law sum;
  sum.count_ = x.count_;
  const auto add = [&sum](std::size_t k, double weight) {
    k = std::min(k, time_law::most_steps);
    if (sum.weights_.size() <= k)
      sum.weights_.resize(k + 1);
    sum.weights_[k] += weight;
  };
  for (std::size_t k = 0; k < x.weights_.size(); ++k) {
    const auto next = (k / every + 1) * every;
    const auto beyond = k % every == 0 ? x.weights_[k] / 2 : x.weights_[k];
    add(next, beyond);
    add(next - every, x.weights_[k] - beyond);
  }
  return sum;
}

} // namespace sofof::policies
