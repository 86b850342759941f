// Fitting an offset over arc length. Frenet geometry: Werling et al. 2010,
// Optimal trajectory generation for dynamic street scenarios.
#include "messages/v2x/mcm/lateral_fit.hpp"

#include "base/geometry.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::messages {
namespace {

constexpr double shortest_knot_m = 1;
constexpr double shortest_m = 0.5; // also of a car that stands

// Standard deviations that tell how plans of cars in a lane are: tuned for
// the planners in Ulm-Lehr, where the offset's curvature follows the lane's.
constexpr double sigma_offset_m = 0.0015;
constexpr double sigma_bend_1pm = 0.0005;
constexpr double sigma_bend_per_bend = 0.2;
constexpr double sigma_kink_1pm3 = 1e-4; // for every metre of step
constexpr double sigma_kink_per_bend = 0.01;
constexpr double sigma_kink_per_kink = 0.3; // of the path's own
constexpr double sigma_slope = 0.01;        // of the beginning
// A plan that does not fit so: it changes lanes, or passes somebody.
constexpr double usual_freedom = 1, great_freedom = 10;
constexpr double rounding_m = 0.005;
constexpr double reach_m = 6; // so far before and behind bends, that holds

// Of the plan in use, which is as uncertain as this one was.
constexpr double sigma_before_m = 0.003;
constexpr double sigma_before_slope = 0.0005;
constexpr double sigma_before_bend_1pm = 0.0005;

constexpr double least_inner = 0.2; // closer to a centre nobody drives

constexpr double weight(double sigma) {
  return 1 / (sigma * sigma);
}

} // namespace

bool lateral_fit::fit(const world::path& line, std::span<const sight> sights,
                      const joint* before) {
  assert(!sights.empty());
  line_ = &line;
  start_m_ = sights.front().at.s_m;
  const auto length_m = std::max(sights.back().at.s_m - start_m_, shortest_m);
  const auto steps = std::clamp(std::ceil(length_m / shortest_knot_m), 1.0,
                                static_cast<double>(p_spline::most_steps));
  steps_ = static_cast<std::size_t>(steps);
  step_m_ = length_m / steps;
  for (std::size_t k = 0; k <= steps_; ++k)
    bend_[k] = line.curvature_1pm(start_m_ + static_cast<double>(k) * step_m_);

  for (const auto freedom : {usual_freedom, great_freedom}) {
    offset_.begin(steps_, step_m_);
    add(sights);
    expect_little(freedom);
    if (before != nullptr)
      expect(*before);
    if (!offset_.solve())
      return false;
    if (meets(sights))
      break;
  }
  measure();
  return true;
}

void lateral_fit::add(std::span<const sight> sights) {
  for (const auto& x : sights) {
    const auto along_m = x.at.s_m - start_m_;
    offset_.observe_value(along_m, x.at.d_m, weight(sigma_offset_m));
    if (x.slope_weight > 0)
      offset_.observe_slope(along_m, x.slope, x.slope_weight);
  }
}

/// @returns whether the curve is as close to what was seen as rounding is.
bool lateral_fit::meets(std::span<const sight> sights) const {
  return std::ranges::all_of(sights, [this](const sight& x) {
    return std::abs(offset_.at(x.at.s_m - start_m_).value - x.at.d_m)
           < rounding_m;
  });
}

/// @returns how sharply the path bends at most, within reach of each knot.
lateral_fit::reachable lateral_fit::sharpest_about() const {
  static_assert(reach_m <= most_reach * shortest_m, "the shortest step");
  const auto reach = static_cast<std::size_t>(std::ceil(reach_m / step_m_));
  const auto width = 2 * reach + 1, count = steps_ + width;
  reachable out;
  std::fill_n(out.begin(), count, 0.0);
  for (std::size_t k = 0; k <= steps_; ++k)
    out[reach + k] = std::abs(bend_[k]);
  // Each becomes the greatest of those up to `span` behind it, which doubles.
  const auto widen = [&](std::size_t by) {
#pragma omp simd
    for (std::size_t i = 0; i < count - by; ++i)
      out[i] = std::max(out[i], out[i + by]);
  };
  std::size_t span = 1;
  for (; 2 * span <= width; span *= 2)
    widen(span);
  widen(width - span);
  return out;
}

/// Without reason a car keeps to its lane and turns the wheel evenly.
void lateral_fit::expect_little(double freedom) {
  const auto sharpest = sharpest_about();
  offset_.observe_slope(0, 0, weight(freedom * sigma_slope));
  column kinks, weights;
  for (std::size_t k = 0; k <= steps_; ++k)
    weights[k] =
        weight(freedom * (sigma_bend_1pm + sigma_bend_per_bend * sharpest[k]));
  offset_.expect_no_bends({weights.data(), steps_ + 1});

  const auto per_step2 = 1 / (step_m_ * step_m_);
  for (std::size_t k = 1; k < steps_; ++k) {
    const auto kink = per_step2 * (2 * bend_[k] - bend_[k + 1] - bend_[k - 1]);
    const auto sigma = sigma_kink_1pm3 + sigma_kink_per_bend * sharpest[k]
                       + sigma_kink_per_kink * std::abs(kink);
    kinks[k - 1] = step_m_ * kink;
    weights[k - 1] = weight(freedom * step_m_ * sigma);
  }
  offset_.expect_kinks({weights.data(), steps_ - 1}, kinks);
}

void lateral_fit::expect(const joint& before) {
  const auto centre = line_->frame(start_m_);
  const auto bend = bend_[0], bend_slope = (bend_[1] - bend_[0]) / step_m_;
  const auto turned = wrap_angle(before.heading_rad - centre.heading_rad);
  const auto d = cross(centre.tangent, before.at - centre.at);
  const auto inner = std::max(least_inner, 1 - bend * d);
  const auto cosine = std::cos(turned), tangent = std::tan(turned);
  const auto slope = tangent * inner;
  offset_.observe_value(0, d, weight(sigma_before_m));
  offset_.observe_slope(0, slope, weight(sigma_before_slope));
  offset_.observe_bend(0,
                       (before.curvature_1pm * inner / cosine - bend) * inner
                               / (cosine * cosine)
                           - (bend_slope * d + bend * slope) * tangent,
                       weight(sigma_before_bend_1pm));
}

void lateral_fit::measure() {
  way_[0] = 0;
  for (std::size_t k = 0; k <= steps_; ++k) {
    const auto x = offset_.at_knot(k);
    const auto inner = std::max(least_inner, 1 - bend_[k] * x.value);
    stretch_[k] = std::sqrt(inner * inner + x.slope * x.slope);
    if (k > 0)
      way_[k] = way_[k - 1] + step_m_ / 2 * (stretch_[k - 1] + stretch_[k]);
  }
}

double lateral_fit::way_m(double s_m) const {
  const auto along =
      std::clamp((s_m - start_m_) / step_m_, 0.0, static_cast<double>(steps_));
  const auto k = std::min(static_cast<std::size_t>(along), steps_ - 1);
  const auto x = along - static_cast<double>(k);
  const auto a = stretch_[k], b = stretch_[k + 1];
  return way_[k] + step_m_ * x * (a + x / 2 * (b - a));
}

double lateral_fit::s_m(double way_m) const {
  const auto behind =
      std::upper_bound(way_.begin() + 1, way_.begin() + steps_, way_m);
  const auto k = static_cast<std::size_t>(behind - way_.begin()) - 1;
  const auto a = stretch_[k], b = stretch_[k + 1];
  // The inverse of way_m; beyond the ends as at them.
  const auto steps = (way_m - way_[k]) / step_m_;
  const auto root = std::sqrt(std::max(a * a + 2 * (b - a) * steps, 1e-6));
  return start_m_ + step_m_ * (static_cast<double>(k) + 2 * steps / (a + root));
}

world::path_point lateral_fit::at(double s_m) const {
  const auto centre = line_->frame(s_m);
  const auto along_m =
      std::clamp(s_m - start_m_, 0.0, static_cast<double>(steps_) * step_m_);
  const auto k =
      std::min(static_cast<std::size_t>(along_m / step_m_), steps_ - 1);
  const auto x = offset_.at(along_m);
  const auto bend = centre.curvature_1pm;
  const auto bend_slope = (bend_[k + 1] - bend_[k]) / step_m_;
  const auto inner = std::max(least_inner, 1 - bend * x.value);
  const auto tangent = x.slope / inner;
  const auto per_stretch2 = 1 / (inner * inner + x.slope * x.slope);
  return {centre.at + x.value * point{-centre.tangent.y_m, centre.tangent.x_m},
          centre.heading_rad + std::atan(tangent),
          ((x.bend + (bend_slope * x.value + bend * x.slope) * tangent) * inner
               * per_stretch2
           + bend)
              * std::sqrt(per_stretch2)};
}

} // namespace sofof::messages
