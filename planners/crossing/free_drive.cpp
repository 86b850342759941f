// Driving alone.
#include "planners/crossing/free_drive.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {
namespace {

/// Nobody is thought of as slower than this, m/s.
constexpr double walking_mps = 1;

} // namespace

free_drive::free_drive(const route_profile& way,
                       const free_drive_limits& limits, double s_m,
                       double speed_mps, double to_m)
    : s_m_{s_m}, first_mps_{std::max(speed_mps, walking_mps)} {
  assert(speed_mps >= 0 && to_m > s_m);
  assert(limits.accel_mps2 > 0 && limits.decel_mps2 > 0);
  const auto count = static_cast<std::size_t>(std::ceil((to_m - s_m) / step_m));
  times_s_.reserve(count + 1);
  times_s_.push_back(0);
  auto w = speed_mps * speed_mps / 2; // v²/2, m²/s²
  for (std::size_t k = 1; k <= count; ++k) {
    const auto top_mps =
        way.envelope.limit_mps(s_m + static_cast<double>(k) * step_m);
    const auto next = std::max(
        std::min(w + limits.accel_mps2 * step_m, top_mps * top_mps / 2),
        w - limits.decel_mps2 * step_m);
    const auto least = walking_mps * walking_mps / 2;
    const auto then = std::max(next, std::min(least, w + least));
    times_s_.push_back(times_s_.back()
                       + 2 * step_m / (std::sqrt(2 * w) + std::sqrt(2 * then)));
    w = then;
  }
  last_mps_ = std::sqrt(2 * w);
  assert(last_mps_ > 0);
}

double free_drive::time_s(double s_m) const {
  const auto steps = (s_m - s_m_) / step_m;
  if (steps <= 0)
    return (s_m - s_m_) / first_mps_;
  if (s_m >= ends_m())
    return times_s_.back() + (s_m - ends_m()) / last_mps_;
  const auto k = std::min(static_cast<std::size_t>(steps), times_s_.size() - 2);
  const auto share = steps - static_cast<double>(k);
  assert(share >= 0 && share <= 1);
  return (1 - share) * times_s_[k] + share * times_s_[k + 1];
}

double free_drive::ends_m() const {
  return s_m_ + static_cast<double>(times_s_.size() - 1) * step_m;
}

} // namespace sofof::planners
