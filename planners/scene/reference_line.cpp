// Sampling a route.
#include "planners/scene/reference_line.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace sofof::planners {
namespace {

constexpr double max_step_m = 0.25;

} // namespace

double seen_limit_mps(std::span<const double> most_mps, double s_m) {
  if (most_mps.empty())
    return std::numeric_limits<double>::infinity();
  const auto i = std::min(static_cast<std::size_t>(std::max(0.0, s_m)),
                          most_mps.size() - 1);
  return std::min(most_mps[i], most_mps[std::min(i + 1, most_mps.size() - 1)]);
}

reference_line::reference_line(world::route_ptr way,
                               std::span<const double> most_mps)
    : way_{std::move(way)} {
  assert(way_ && way_->length_m() > 0);
  const auto length_m = way_->length_m();
  const auto steps =
      std::max(1L, std::lround(std::ceil(length_m / max_step_m)));
  const auto step_m = length_m / static_cast<double>(steps);
  assert(step_m > 0 && step_m <= max_step_m);
  steps_per_m_ = 1 / step_m;
  laps_per_m_ = 1 / length_m;
  for (long i = 0; i <= steps; ++i) {
    const auto s = static_cast<double>(i) * step_m;
    table_.push_back({way_->path().at(s).curvature_1pm,
                      std::min(way_->limit_mps(s), seen_limit_mps(most_mps, s)),
                      way_->half_width_m(s)});
  }
}

reference_line::place reference_line::find(double s_m) const {
  assert(table_.size() >= 2);
  const auto length_m = way_->length_m();
  if (way_->closed())
    s_m -= std::floor(s_m * laps_per_m_) * length_m;
  const auto steps = std::clamp(s_m, 0.0, length_m) * steps_per_m_;
  // What is no number stays none, in the share.
  const auto i =
      steps >= 0 ? std::min(static_cast<std::size_t>(steps), table_.size() - 2)
                 : 0;
  assert(!(steps < static_cast<double>(i)));
  return {table_[i], table_[i + 1], steps - static_cast<double>(i)};
}

double reference_line::curvature_1pm(double s_m) const {
  const auto p = find(s_m);
  return p.low.curvature_1pm
         + p.share * (p.high.curvature_1pm - p.low.curvature_1pm);
}

double reference_line::limit_mps(double s_m) const {
  const auto p = find(s_m);
  return std::min(p.low.limit_mps, p.high.limit_mps);
}

double reference_line::half_width_m(double s_m) const {
  const auto p = find(s_m);
  return std::min(p.low.half_width_m, p.high.half_width_m);
}

// The curvature counts once more the further it lies back: Simpson's rule.
double reference_line::bow_m(double s_m, double ahead_m) const {
  return ahead_m * ahead_m
         * (curvature_1pm(s_m) / 6 + curvature_1pm(s_m + ahead_m / 2) / 3);
}

} // namespace sofof::planners
