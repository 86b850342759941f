// Bodies that move and would touch.
#include "planners/scene/told_drive.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {
namespace {

/// Bodies are compared at moments so far apart.
constexpr duration compared_every = std::chrono::milliseconds{100};

/// A way, and a time.
constexpr double unkept_m = 1.5, unkept_s = 0.3;

double half_diagonal_m(const oriented_box& x) {
  return std::hypot(x.length_m, x.width_m) / 2;
}

} // namespace

oriented_box claimed_drive::at(time_point t) const {
  assert(!bodies.empty() && step > duration{});
  const auto last = static_cast<double>(bodies.size() - 1);
  const auto place =
      std::clamp(to_seconds(t - from) / to_seconds(step), 0.0, last);
  const auto k = static_cast<std::size_t>(place);
  if (k + 1 >= bodies.size())
    return bodies.back();
  const auto share = place - static_cast<double>(k);
  assert(share >= 0 && share <= 1);
  auto x = bodies[k];
  const auto& next = bodies[k + 1];
  x.centre = x.centre + share * (next.centre - x.centre);
  x.heading_rad += share * wrap_angle(next.heading_rad - x.heading_rad);
  return x;
}

double most_behind_m(double speed_mps) {
  assert(std::isfinite(speed_mps));
  return std::max(unkept_m, unkept_s * speed_mps);
}

bool overlap(const claimed_drive& a, const claimed_drive& b, duration apart) {
  assert(apart >= duration{});
  if (a.empty() || b.empty() || a.from > b.to() + apart
      || b.from > a.to() + apart)
    return false;
  assert(a.step > duration{} && b.step > duration{});
  for (auto t = a.from; t <= a.to(); t += compared_every) {
    const auto own = a.at(t);
    const auto last = std::min(t + apart, b.to());
    for (auto u = std::max(t - apart, b.from); u <= last; u += compared_every) {
      const auto other = b.at(u);
      const auto reach_m = half_diagonal_m(own) + half_diagonal_m(other);
      const auto to = other.centre - own.centre;
      if (dot(to, to) < reach_m * reach_m && overlap(own, other))
        return true;
    }
  }
  return false;
}

} // namespace sofof::planners
