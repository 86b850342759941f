// Student's t, and means by it.
#include "experiments/dehler2025/normal_interval.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace sofof::experiments::study {

namespace {

/// @param angle  arctan(t / √degrees).
/// @returns the probability that Student's distribution is nearer to 0 than t.
double share_within(double angle, std::size_t degrees) {
  const auto is_odd = degrees % 2 == 1;
  const auto c = std::cos(angle);
  double series = 0, term = is_odd ? c : 1;
  for (std::size_t k = is_odd ? 1 : 0; k + 2 <= degrees; k += 2) {
    series += term;
    const auto n = static_cast<double>(k);
    term *= c * c * (n + 1) / (n + 2);
  }
  const auto curved = std::sin(angle) * series;
  return is_odd ? 2 / std::numbers::pi * (angle + curved) : curved;
}

} // namespace

double student_t_95(std::size_t degrees) {
  assert(degrees >= 1);
  constexpr int halvings = 60;
  double low = 0, high = std::numbers::pi / 2;
  for (int i = 0; i < halvings; ++i) {
    const auto middle = (low + high) / 2;
    const auto is_below =
        share_within(middle, degrees) < 1 - 2 * outside_each_side;
    (is_below ? low : high) = middle;
  }
  return std::sqrt(static_cast<double>(degrees)) * std::tan(low);
}

std::optional<interval> normal_mean_interval(std::span<const group> groups) {
  double sum = 0, count = 0, n = 0;
  for (const auto& g : groups)
    if (g.count > 0) {
      sum += g.sum;
      count += g.count;
      ++n;
    }
  if (n < 2)
    return std::nullopt;
  const auto mean = sum / count;
  double squares = 0;
  for (const auto& g : groups)
    if (g.count > 0)
      squares += std::pow(g.sum / g.count - mean, 2);
  const auto half = student_t_95(static_cast<std::size_t>(n) - 1)
                    * std::sqrt(squares / (n - 1) / n);
  return interval{mean, mean - half, mean + half};
}

} // namespace sofof::experiments::study
