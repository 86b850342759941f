// Times at places, and driving alone.
#include "planners/crossing/way_motion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {
namespace {

/// Nobody is thought of as slower than this, m/s.
constexpr double walking_mps = 1;

/// Who takes longer for a step stands, and then sets off like this.
constexpr double stands_s = 2, sets_off_in_s = 0.9;

} // namespace

way_motion::way_motion(double from_m, std::vector<double> times_s)
    : from_m_{from_m}, times_s_{std::move(times_s)} {
  assert(times_s_.size() >= 2);
  assert(std::ranges::is_sorted(times_s_));
}

double way_motion::time_s(double at_m) const {
  assert(std::isfinite(at_m));
  assert(times_s_.size() >= 2);
  const auto steps = (at_m - from_m_) / step_m;
  const auto last = static_cast<double>(times_s_.size() - 2);
  const auto k = std::clamp(std::floor(steps), 0.0, last);
  const auto i = static_cast<std::size_t>(k);
  auto takes_s = times_s_[i + 1] - times_s_[i];
  if (steps < 0 || steps > last + 1) // at walking pace at least
    takes_s = std::min(takes_s, step_m / walking_mps);
  const auto base = steps > last + 1 ? times_s_.back() - takes_s : times_s_[i];
  return base + (steps - k) * takes_s;
}

double way_motion::place_m(double at_s) const {
  assert(!std::isnan(at_s));
  assert(times_s_.size() >= 2);
  const auto next = std::ranges::upper_bound(times_s_, at_s);
  if (next == times_s_.begin())
    return from_m_;
  if (next == times_s_.end())
    return ends_m();
  const auto i = static_cast<std::size_t>(next - times_s_.begin()) - 1;
  const auto takes_s = times_s_[i + 1] - times_s_[i];
  auto share = (at_s - times_s_[i]) / takes_s;
  if (takes_s > stands_s) { // at its begin, and sets off in time
    const auto since_s = sets_off_in_s - (times_s_[i + 1] - at_s);
    share =
        since_s > 0 ? since_s * since_s / (sets_off_in_s * sets_off_in_s) : 0.0;
  }
  return from_m_ + step_m * (static_cast<double>(i) + share);
}

way_motion drive_freely(const route_profile& way,
                        const free_drive_limits& limits, double s_m,
                        double speed_mps, double to_m) {
  assert(speed_mps >= 0 && to_m > s_m);
  assert(limits.accel_mps2 > 0 && limits.decel_mps2 > 0);
  constexpr auto step_m = way_motion::step_m;
  const auto count = std::max<std::size_t>(
      1, static_cast<std::size_t>(std::ceil((to_m - s_m) / step_m)));
  std::vector<double> times_s{0};
  times_s.reserve(count + 1);
  auto w = speed_mps * speed_mps / 2; // v²/2, m²/s²
  for (std::size_t k = 1; k <= count; ++k) {
    const auto top_mps =
        way.envelope.limit_mps(s_m + static_cast<double>(k) * step_m);
    const auto next = std::max(
        std::min(w + limits.accel_mps2 * step_m, top_mps * top_mps / 2),
        w - limits.decel_mps2 * step_m);
    const auto least = walking_mps * walking_mps / 2;
    const auto then = std::max(next, std::min(least, w + least));
    times_s.push_back(times_s.back()
                      + 2 * step_m / (std::sqrt(2 * w) + std::sqrt(2 * then)));
    w = then;
  }
  return {s_m, std::move(times_s)};
}

} // namespace sofof::planners
