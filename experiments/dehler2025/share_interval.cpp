// Limits where as few or as many events would be too unlikely.
#include "experiments/dehler2025/share_interval.hpp"

#include <cassert>
#include <cmath>

namespace sofof::experiments::study {

namespace {

/// @param share  In (0, 1).
/// @returns the probability of at most `events` of `of`.
double probability_of_at_most(std::uint64_t events, std::uint64_t of,
                              double share) {
  const auto n = static_cast<double>(of);
  double all = 0;
  for (std::uint64_t i = 0; i <= events; ++i) {
    const auto k = static_cast<double>(i);
    all += std::exp(std::lgamma(n + 1) - std::lgamma(k + 1)
                    - std::lgamma(n - k + 1) + k * std::log(share)
                    + (n - k) * std::log1p(-share));
  }
  return all;
}

/// @param below  Holds for shares up to some share, and not beyond it.
/// @returns that share.
template <class Predicate>
double border_of(Predicate below) {
  constexpr int halvings = 50; // beyond what a double tells apart near 1
  double low = 0, high = 1;
  for (int i = 0; i < halvings; ++i) {
    const auto middle = (low + high) / 2;
    (below(middle) ? low : high) = middle;
  }
  return low;
}

} // namespace

interval share_interval(std::uint64_t events, std::uint64_t of) {
  assert(of >= 1 && events <= of);
  interval all{static_cast<double>(events) / static_cast<double>(of), 0, 1};
  if (events > 0)
    all.low = border_of([&](double share) {
      return 1 - probability_of_at_most(events - 1, of, share)
             < outside_each_side;
    });
  if (events < of)
    all.high = border_of([&](double share) {
      return probability_of_at_most(events, of, share) > outside_each_side;
    });
  return all;
}

} // namespace sofof::experiments::study
