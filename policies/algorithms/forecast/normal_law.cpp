// The standard normal law: how likely, and how far out.
#include "policies/algorithms/forecast/normal_law.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace sofof::policies {

namespace {

/// @param p  In (0, 0.5].
/// @returns the quantile within 4.5e-4 (Abramowitz & Stegun 26.2.23).
double rough_quantile(double p) {
  const auto t = std::sqrt(-2 * std::log(p));
  const auto above = 2.515517 + t * (0.802853 + t * 0.010328);
  const auto below = 1 + t * (1.432788 + t * (0.189269 + t * 0.001308));
  return above / below - t;
}

/// @returns a quantile with about three times as many right digits.
double refined_quantile(double x, double p) {
  const auto slope = std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi);
  const auto newton = (normal_cdf(x) - p) / slope;
  return x - newton / (1 + x * newton / 2);
}

} // namespace

double normal_cdf(double x) {
  return std::erfc(-x / std::numbers::sqrt2) / 2;
}

double normal_quantile(double p) {
  if (!(p >= 0 && p <= 1))
    return std::numeric_limits<double>::quiet_NaN();
  if (p > 0.5)
    return -normal_quantile(1 - p);
  if (p == 0)
    return -std::numeric_limits<double>::infinity();
  return refined_quantile(refined_quantile(rough_quantile(p), p), p);
}

} // namespace sofof::policies
