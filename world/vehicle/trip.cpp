// How long a drive takes, and what it would take a car that is alone.
#include "world/vehicle/trip.hpp"

#include <cassert>
#include <cmath>

namespace sofof::world {
namespace {

constexpr double sideways_mps2 = 2.2, speeds_up_mps2 = 1.5, brakes_mps2 = 2;
/// Nobody creeps, or a car at rest would never leave its place.
constexpr double least_mps = 0.5;
/// Slower than this a car is at rest; faster than that it has moved.
constexpr double rests_mps = 0.1, moves_mps = 1;

} // namespace

drive_alone::drive_alone(const route& way, double from_m, double speed_mps)
    : from_m_{from_m} {
  assert(speed_mps >= 0);
  // A closed route twice: the second lap begins at speed.
  const auto left_m = way.closed() ? 2 * way.length_m()
                                   : std::max(step_m, way.length_m() - from_m);
  const auto count = static_cast<std::size_t>(std::ceil(left_m / step_m));
  std::vector<double> most(count + 1); // v²/2
  for (auto k = count + 1; k-- > 0;) {
    const auto s = from_m + static_cast<double>(k) * step_m;
    const auto on = way.closed() ? std::fmod(s, way.length_m())
                                 : std::min(s, way.length_m());
    const auto limit = way.limit_mps(on);
    const auto bend = std::abs(way.path().at(on).curvature_1pm);
    most[k] = limit * limit / 2;
    if (bend * limit * limit > sideways_mps2)
      most[k] = sideways_mps2 / bend / 2;
    if (k < count)
      most[k] = std::min(most[k], most[k + 1] + brakes_mps2 * step_m);
  }
  times_s_.assign(1, 0.0);
  times_s_.reserve(count + 1);
  auto w = speed_mps * speed_mps / 2;
  for (std::size_t k = 1; k <= count; ++k) {
    const auto next = std::max(std::min(w + speeds_up_mps2 * step_m, most[k]),
                               least_mps * least_mps / 2);
    times_s_.push_back(times_s_.back()
                       + 2 * step_m / (std::sqrt(2 * w) + std::sqrt(2 * next)));
    w = next;
  }
  if (way.closed()) {
    lap_m_ = way.length_m();
    lap_s_ = times_s_.back()
             - times_s_[static_cast<std::size_t>(lap_m_ / step_m)];
  }
  assert(times_s_.size() >= 2);
}

double drive_alone::time_s(double to_m) const {
  auto way_m = to_m - from_m_;
  if (way_m <= 0)
    return 0;
  auto laps_s = 0.0;
  if (const auto known_m = static_cast<double>(times_s_.size() - 1) * step_m;
      lap_m_ > 0 && way_m > known_m) {
    const auto more = std::ceil((way_m - known_m) / lap_m_);
    way_m -= more * lap_m_;
    laps_s = more * lap_s_;
  }
  const auto last = static_cast<double>(times_s_.size() - 2);
  const auto k = std::min(std::floor(way_m / step_m), last);
  const auto i = static_cast<std::size_t>(k);
  const auto share = std::min(1.0, way_m / step_m - k);
  return laps_s + std::lerp(times_s_[i], times_s_[i + 1], share);
}

void trip_meter::add(double speed_mps, double step_s) {
  has_moved_ = has_moved_ || speed_mps > moves_mps;
  if (speed_mps > rests_mps) {
    stands_ = stands_ && speed_mps < moves_mps;
    stood_s_ = 0;
    return;
  }
  stood_s_ += step_s;
  longest_s_ = std::max(longest_s_, has_moved_ ? stood_s_ : 0.0);
  if (has_moved_ && !stands_) {
    stands_ = true;
    ++stops_;
  }
}

} // namespace sofof::world
