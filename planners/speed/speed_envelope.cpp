// The speed envelope, made in passes over a table of v²/2, whose slope along
// the way is acceleration.
#include "planners/speed/speed_envelope.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {
namespace {

constexpr double longest_step_m = 1.0;
constexpr double min_curvature_1pm = 1e-6;
constexpr double min_speed_mps = 0.1;
// The envelope brakes with less jerk than the car may, so that a car on it
// has some left for corrections.
constexpr double table_share_of_jerk = 0.7;

/// A table over the way; before and after it goes on around (closed) or at
/// its rim (open).
struct way_table {
  std::vector<double> values;
  bool closed;

  double operator[](long i) const {
    const auto n = static_cast<long>(values.size());
    return values[closed ? ((i % n) + n) % n : std::clamp(i, 0L, n - 1)];
  }
  long size() const { return static_cast<long>(values.size()); }
};

/// v²/2 that limits and bends allow at a place.
double allowed_at(const world::route& way, double s_m,
                  const comfort_limits& params,
                  std::span<const double> most_mps) {
  assert(std::isfinite(s_m) && params.max_lateral_accel_mps2 > 0);
  const auto bend = std::abs(way.path().at(s_m).curvature_1pm);
  const auto limit =
      std::max(min_speed_mps,
               std::min(way.limit_mps(s_m), seen_limit_mps(most_mps, s_m)));
  return std::min(limit * limit, params.max_lateral_accel_mps2
                                     / std::max(bend, min_curvature_1pm))
         / 2;
}

/// What is allowed all along the way. A place counts with its surroundings up
/// to the entries beside it, so that the line between two entries stays below
/// what is allowed between them.
way_table allowed(const world::route& way, double step_m, long size,
                  const comfort_limits& params,
                  std::span<const double> most_mps) {
  assert(step_m > 0 && size > 0);
  way_table half{{}, way.closed()}; // in half steps
  for (long i = 0; i < 2 * size; ++i)
    half.values.push_back(
        allowed_at(way, static_cast<double>(i) * step_m / 2, params, most_mps));
  way_table u{{}, way.closed()};
  for (long i = 0; i < 2 * size; i += 2)
    u.values.push_back(std::min(
        {half[i - 2], half[i - 1], half[i], half[i + 1], half[i + 2]}));
  assert(std::ranges::all_of(u.values, [](double x) { return x > 0; }));
  return u;
}

/// No slow place is left (`way` 1) or approached (`way` -1) with more than
/// `accel`, which builds up from the slow place at `jerk`.
void ramp_from_slow(way_table& u, long way, double step_m, double accel,
                    double jerk) {
  assert(way == 1 || way == -1);
  assert(accel > 0 && jerk > 0);
  auto slope = 0.0;
  const auto entries = u.closed ? 2 * u.size() : u.size();
  for (long k = 1; k < entries; ++k) {
    const auto i = (way > 0 ? k : entries - 1 - k) % u.size();
    const auto slow = u[i - way];
    assert(slow > 0);
    slope = std::min(accel, slope + jerk * step_m / std::sqrt(2 * slow));
    u.values[i] = std::min(u[i], slow + slope * step_m);
    slope = std::clamp((u[i] - slow) / step_m, 0.0, accel);
  }
}

/// Cuts the corners where speeding up ends and braking sets in: the mean over
/// as much way as the car makes while its brake builds up.
way_table rounded(const way_table& u, double step_m, double build_up_s) {
  assert(step_m > 0 && build_up_s > 0);
  auto round = u;
  for (long i = 0; i < u.size(); ++i) {
    const auto reach =
        std::min<long>(u.size() / 2, std::lround(std::sqrt(2 * u[i])
                                                 * build_up_s / 2 / step_m));
    auto sum = u[i];
    for (long k = 1; k <= reach; ++k)
      sum += u[i - k] + u[i + k];
    round.values[i] = std::min(u[i], sum / static_cast<double>(2 * reach + 1));
    assert(round.values[i] > 0);
  }
  return round;
}

} // namespace

speed_envelope::speed_envelope(const world::route& way,
                               const comfort_limits& params,
                               std::span<const double> most_mps)
    : length_m_{way.length_m()}, closed_{way.closed()} {
  assert(length_m_ > 0 && params.max_accel_mps2 > 0);
  assert(params.comfort_decel_mps2 > 0 && params.max_jerk_mps3 > 0);
  const auto steps =
      std::max(2L, std::lround(std::ceil(length_m_ / longest_step_m)));
  const auto step_m = length_m_ / static_cast<double>(steps);
  steps_per_m_ = static_cast<double>(steps) / length_m_;
  laps_per_m_ = 1 / length_m_;
  const auto decel = params.comfort_decel_mps2;
  const auto jerk = table_share_of_jerk * params.max_jerk_mps3;

  auto u = allowed(way, step_m, closed_ ? steps : steps + 1, params, most_mps);
  ramp_from_slow(u, 1, step_m, params.max_accel_mps2, jerk);
  ramp_from_slow(u, -1, step_m, decel, jerk);
  assert(u.size() == (closed_ ? steps : steps + 1));
  u = rounded(u, step_m, decel / jerk);

  table_.reserve(static_cast<std::size_t>(steps) + 1);
  for (long i = 0; i <= steps; ++i)
    table_.push_back(
        {std::sqrt(2 * u[i]), (u[i + 1] - u[i - 1]) / (2 * step_m)});
}

speed_envelope::sample speed_envelope::at(double s_m) const {
  assert(std::isfinite(s_m) && table_.size() >= 2);
  if (closed_)
    s_m -= std::floor(s_m * laps_per_m_) * length_m_;
  const auto steps = std::clamp(s_m, 0.0, length_m_) * steps_per_m_;
  const auto i = std::min(static_cast<std::size_t>(steps), table_.size() - 2);
  const auto share = std::min(steps - static_cast<double>(i), 1.0);
  const auto &low = table_[i], &high = table_[i + 1];
  assert(low.speed_mps > 0 && high.speed_mps > 0);
  return {low.speed_mps + share * (high.speed_mps - low.speed_mps),
          low.accel_mps2 + share * (high.accel_mps2 - low.accel_mps2)};
}

} // namespace sofof::planners
