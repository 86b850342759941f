// A route as the traffic sees it: its lanes and its crossings, lap after lap.
#include "world/roads/unrolled_route.hpp"

#include <limits>
#include <utility>

namespace sofof::world {

namespace {

/// Drivers take bends at about this lateral acceleration, m/s².
constexpr auto lateral_accel_mps2 = 2.0;

/// @returns the highest speed at which a whole stretch can be driven.
double find_pace_mps(const route& on, double from_m, double to_m) {
  auto pace = on.limit_mps(from_m);
  for (auto s_m = from_m; s_m < to_m; s_m += 1) {
    const auto bend_1pm = std::abs(on.path().at(s_m).curvature_1pm);
    pace = std::min(pace, on.limit_mps(s_m));
    if (bend_1pm * pace * pace > lateral_accel_mps2)
      pace = std::sqrt(lateral_accel_mps2 / bend_1pm);
  }
  return pace;
}

} // namespace

unrolled_route::unrolled_route(route_ptr on, const conflict_sides& all)
    : on_{std::move(on)} {
  for (leg i = 0; i < legs(); ++i)
    for (const auto& e : all[lane(i)]) {
      if (e.how == conflict::kind::diverge)
        continue;
      const auto from_m = start_m(i) + e.from_m, to_m = start_m(i) + e.to_m;
      zones_.push_back(
          {from_m, to_m, e.side, e.rank, find_pace_mps(*on_, from_m, to_m)});
      longest_zone_m_ = std::max(longest_zone_m_, to_m - from_m);
    }
  std::ranges::stable_sort(zones_, {}, &zone::from_m);
}

unrolled_route::leg unrolled_route::leg_at(double s_m) const {
  const auto laps = on_->closed() ? std::floor(s_m / on_->length_m()) : 0.0;
  s_m -= laps * on_->length_m();
  leg i = 0, last = legs() - 1;
  while (i < last) {
    const auto middle = i + (last - i + 1) / 2;
    if (on_->start_of_m(static_cast<std::size_t>(middle)) <= s_m)
      i = middle;
    else
      last = middle - 1;
  }
  return i + static_cast<leg>(laps) * legs();
}

double unrolled_route::end_m() const {
  return on_->closed() ? std::numeric_limits<double>::infinity()
                       : on_->length_m();
}

} // namespace sofof::world
