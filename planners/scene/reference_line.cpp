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
  sections_at_.reserve(static_cast<std::size_t>(steps) + 1);
  for (long i = 0; i <= steps; ++i) {
    const auto s = static_cast<double>(i) * step_m;
    const auto road = way_->bounds_at(s);
    const section here{std::min(road.limit_mps, seen_limit_mps(most_mps, s)),
                       road.half_width_m};
    if (sections_.empty() || here != sections_.back())
      sections_.push_back(here);
    sections_at_.push_back(static_cast<std::uint32_t>(sections_.size() - 1));
  }
  sections_.shrink_to_fit();
}

std::pair<const reference_line::section&, const reference_line::section&>
reference_line::around(double s_m) const {
  assert(sections_at_.size() >= 2);
  const auto length_m = way_->length_m();
  if (way_->closed())
    s_m -= std::floor(s_m * laps_per_m_) * length_m;
  const auto steps = std::clamp(s_m, 0.0, length_m) * steps_per_m_;
  const auto i = steps >= 0 ? std::min(static_cast<std::size_t>(steps),
                                       sections_at_.size() - 2)
                            : 0; // what is no number, too
  assert(!(steps < static_cast<double>(i)));
  return {sections_[sections_at_[i]], sections_[sections_at_[i + 1]]};
}

double reference_line::curvature_1pm(double s_m) const {
  return std::isfinite(s_m) ? way_->path().curvature_1pm(s_m)
                            : std::numeric_limits<double>::quiet_NaN();
}

double reference_line::limit_mps(double s_m) const {
  const auto [low, high] = around(s_m);
  return std::min(low.limit_mps, high.limit_mps);
}

double reference_line::half_width_m(double s_m) const {
  const auto [low, high] = around(s_m);
  return std::min(low.half_width_m, high.half_width_m);
}

// The curvature counts once more the further it lies back: Simpson's rule.
double reference_line::bow_m(double s_m, double ahead_m) const {
  return ahead_m * ahead_m
         * (curvature_1pm(s_m) / 6 + curvature_1pm(s_m + ahead_m / 2) / 3);
}

} // namespace sofof::planners
