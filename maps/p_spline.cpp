// A smooth curve beside a polyline.
#include "maps/p_spline.hpp"

#include "maps/polyline.hpp"
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sofof::maps {

namespace {

constexpr auto step_m = 1.0;
constexpr std::size_t least_steps = 6, most_steps = 10'000;

constexpr auto strongest = 65536.0, weakest = 0.01, weaker = 0.25;

/// Third differences of four neighbours.
constexpr std::array difference{-1.0, 3.0, -3.0, 1.0};
constexpr std::size_t band = difference.size();

/// A symmetric matrix of which only the diagonal and three below it are not 0,
/// with two right sides.
class band_system {
public:
  explicit band_system(std::size_t size) : rows_(size), right_(size) {}

  double& at(std::size_t row, std::size_t below) { return rows_[row][below]; }
  point& right(std::size_t row) { return right_[row]; }

  /// Solves by L D L'; the matrix is positive definite.
  std::vector<point> solve() && {
    const auto n = rows_.size();
    for (std::size_t i = 0; i < n; ++i) {
      for (auto k = std::min(i, band - 1); k > 0; --k) {
        const auto j = i - k;
        for (std::size_t m = k + 1; m < band && m <= i; ++m)
          rows_[i][k] -= rows_[i][m] * rows_[j][m - k] * rows_[i - m][0];
        rows_[i][k] /= rows_[j][0];
      }
      for (std::size_t k = 1; k < band && k <= i; ++k) {
        rows_[i][0] -= rows_[i][k] * rows_[i][k] * rows_[i - k][0];
        right_[i] = right_[i] - rows_[i][k] * right_[i - k];
      }
    }
    for (std::size_t i = 0; i < n; ++i)
      right_[i] = (1 / rows_[i][0]) * right_[i];
    for (auto i = n; i-- > 0;)
      for (std::size_t k = 1; k < band && i + k < n; ++k)
        right_[i] = right_[i] - rows_[i + k][k] * right_[i + k];
    return std::move(right_);
  }

private:
  std::vector<std::array<double, band>> rows_; // [i][k]: row i, column i - k
  std::vector<point> right_;
};

/// Samples of the source, its ends moved to where they have to be.
std::vector<point> sampled(std::span<const point> source,
                           const curve_ends& ends) {
  const auto length = length_m(source);
  const auto count =
      std::clamp(static_cast<std::size_t>(std::ceil(length / step_m)),
                 least_steps, most_steps);
  std::vector<point> all;
  line_walk along{source};
  for (std::size_t i = 0; i <= count; ++i)
    all.push_back(
        along.to(length * static_cast<double>(i) / static_cast<double>(count)));
  all.front() = ends.start;
  all.back() = ends.end;
  return all;
}

/// @param penalty  Of third differences, against squares of distances.
std::vector<point> fit(std::span<const point> samples, const curve_ends& ends,
                       double penalty) {
  const auto last = samples.size() - 1;
  const auto step = length_m(samples) / static_cast<double>(last);
  // The point i of the curve with two more, straight on, at either end.
  const auto is_free = [last](std::ptrdiff_t i) {
    return i > 0 && i < static_cast<std::ptrdiff_t>(last);
  };
  const auto fixed = [&](std::ptrdiff_t i) {
    const auto beyond = static_cast<double>(i) - static_cast<double>(last);
    return i <= 0 ? ends.start
                        + (static_cast<double>(i) * step) * ends.start_direction
                  : ends.end + (beyond * step) * ends.end_direction;
  };
  band_system all{last - 1};
  for (std::size_t i = 1; i < last; ++i) {
    all.at(i - 1, 0) = 1;
    all.right(i - 1) = samples[i];
  }
  for (auto j = std::ptrdiff_t{-2}; j + 1 <= static_cast<std::ptrdiff_t>(last);
       ++j)
    for (std::size_t a = 0; a < band; ++a) {
      const auto row = j + static_cast<std::ptrdiff_t>(a);
      if (!is_free(row))
        continue;
      const auto i = static_cast<std::size_t>(row - 1);
      for (std::size_t b = 0; b < band; ++b) {
        const auto weight = penalty * difference[a] * difference[b];
        const auto column = j + static_cast<std::ptrdiff_t>(b);
        if (!is_free(column))
          all.right(i) = all.right(i) - weight * fixed(column);
        else if (b <= a)
          all.at(i, a - b) += weight;
      }
    }
  auto curve = std::move(all).solve();
  curve.insert(curve.begin(), ends.start);
  curve.push_back(ends.end);
  return curve;
}

/// @returns how far a curve is from its source at most; each of its points is
/// measured to what of the source lies beside it.
double farthest_m(std::span<const point> curve, std::span<const point> source) {
  constexpr auto beside_m = 15.0;
  const auto per_point_m =
      length_m(source) / static_cast<double>(curve.size() - 1);
  auto farthest = 0.0, first_ends_m = distance_m(source[0], source[1]);
  std::size_t first = 0; // segment that may be near
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const auto s_m = static_cast<double>(i) * per_point_m;
    while (first + 2 < source.size() && first_ends_m < s_m - beside_m) {
      ++first;
      first_ends_m += distance_m(source[first], source[first + 1]);
    }
    auto least = std::numeric_limits<double>::infinity();
    auto begins_m = first_ends_m - distance_m(source[first], source[first + 1]);
    for (auto k = first; k + 1 < source.size() && begins_m < s_m + beside_m;
         ++k) {
      least = std::min(
          least, distance_to_segment_m(curve[i], source[k], source[k + 1]));
      begins_m += distance_m(source[k], source[k + 1]);
    }
    farthest = std::max(farthest, least);
  }
  return farthest;
}

} // namespace

fitted_curve fit_p_spline(std::span<const point> source, const curve_ends& ends,
                          const curve_limits& limits) {
  assert(source.size() >= 2);
  assert(limits.off_m > 0);
  const auto samples = sampled(source, ends);
  fitted_curve best;
  best.sharpest_1pm = std::numeric_limits<double>::infinity();
  for (auto penalty = strongest; penalty > weakest; penalty *= weaker) {
    auto curve = fit(samples, ends, penalty);
    if (farthest_m(curve, source) > limits.off_m && penalty * weaker > weakest)
      continue;
    const auto sharpest_1pm = sharpest_of(curve, ends);
    if (sharpest_1pm < best.sharpest_1pm)
      best = {std::move(curve), sharpest_1pm};
    if (best.sharpest_1pm <= limits.curvature_1pm)
      break;
  }
  if (best.points.empty())
    best = {samples, sharpest_of(samples, ends)};
  return best;
}

std::vector<point> thinned(std::span<const point> curve) {
  constexpr auto at_ends_m = 3.0, least_m = 0.9, most_m = 20.0;
  constexpr auto turn_rad = 0.12, growth = 0.5;
  const auto last = curve.size() - 1;
  std::vector<double> gap_m(curve.size(), most_m);
  gap_m.front() = gap_m.back() = at_ends_m;
  for (std::size_t i = 1; i < last; ++i)
    gap_m[i] =
        std::clamp(turn_rad / (bend_1pm(curve, i) + 1e-9), least_m, most_m);
  for (std::size_t i = 1; i <= last; ++i)
    gap_m[i] = std::min(
        gap_m[i], gap_m[i - 1] + growth * distance_m(curve[i - 1], curve[i]));
  for (auto i = last; i-- > 0;)
    gap_m[i] = std::min(
        gap_m[i], gap_m[i + 1] + growth * distance_m(curve[i + 1], curve[i]));
  std::vector<point> kept{curve.front()};
  auto since_m = 0.0, to_end_m = length_m(curve);
  for (std::size_t i = 1; i < last; ++i) {
    const auto gone_m = distance_m(curve[i - 1], curve[i]);
    since_m += gone_m;
    to_end_m -= gone_m;
    if (since_m + 1e-6 < gap_m[i] || to_end_m < least_m / 2)
      continue;
    kept.push_back(curve[i]);
    since_m = 0;
  }
  kept.push_back(curve.back());
  return kept;
}

} // namespace sofof::maps
