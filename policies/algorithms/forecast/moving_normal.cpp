// A normal law that follows a stream of numbers.
#include "policies/algorithms/forecast/moving_normal.hpp"

#include "policies/algorithms/forecast/normal_law.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::policies {

void moving_normal::add(double x, double times) {
  assert(times >= 1);
  if (!std::isfinite(x))
    return;
  ++count_;
  const auto fading = times == 1 ? alpha_ : 1 - std::pow(1 - alpha_, times);
  const auto weight = std::max(fading, 1 / static_cast<double>(count_));
  const auto off = x - mean_;
  mean_ += weight * off;
  variance_ = (1 - weight) * (variance_ + weight * off * off);
}

double moving_normal::probability_above(double limit) const {
  if (variance_ <= 0)
    return mean_ > limit ? 1 : 0;
  return normal_cdf((mean_ - limit) / std::sqrt(variance_));
}

double moving_normal::quantile(double p) const {
  assert(p > 0 && p < 1);
  if (variance_ <= 0)
    return mean_;
  return mean_ + normal_quantile(p) * std::sqrt(variance_);
}

} // namespace sofof::policies
