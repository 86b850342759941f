// Sweeping two bodies along their paths.
#include "world/roads/meeting_curve.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

namespace sofof::world {
namespace {

/// The places of a body on its way.
std::vector<oriented_box> sweep(const path_stretch& along,
                                const moving_body& body) {
  const auto count = static_cast<std::size_t>(
      std::ceil((along.to_m - along.from_m) / meeting_curve::step_m));
  std::vector<oriented_box> boxes;
  for (std::size_t i = 0; i <= count; ++i) {
    const auto at = along.on->at(
        along.from_m + static_cast<double>(i) * meeting_curve::step_m);
    boxes.push_back({at.at, at.heading_rad, body.length_m, body.width_m});
  }
  assert(!boxes.empty());
  return boxes;
}

double radius_m(const moving_body& body) {
  return std::hypot(body.length_m, body.width_m) / 2;
}

/// @param reach_m  Of both bodies together.
/// @returns the last of the boxes that another one touches.
std::optional<std::size_t> last_touching(const std::vector<oriented_box>& boxes,
                                         const oriented_box& other,
                                         double reach_m) {
  for (auto i = boxes.size(); i > 0;) {
    const auto away_m = distance_m(boxes[i - 1].centre, other.centre) - reach_m;
    if (away_m <= 0 && overlap(boxes[i - 1], other))
      return i - 1;
    // No step brings it nearer by more than its length.
    const auto steps = 1
                       + static_cast<std::size_t>(std::max(0.0, away_m)
                                                  / meeting_curve::step_m);
    i -= std::min(i, steps);
  }
  return std::nullopt;
}

} // namespace

meeting_curve::meeting_curve(const path_stretch& first,
                             const moving_body& first_body,
                             const path_stretch& second,
                             const moving_body& second_body) {
  assert(first.on && first.from_m < first.to_m);
  assert(second.on && second.from_m < second.to_m);
  const auto ahead = sweep(first, first_body);
  const auto behind = sweep(second, second_body);
  const auto reach_m = radius_m(first_body) + radius_m(second_body);
  auto farthest_m = no_matter;
  for (std::size_t k = 0; k < behind.size(); ++k) {
    const auto last = last_touching(ahead, behind[k], reach_m);
    const auto here_m = second.from_m + static_cast<double>(k) * step_m;
    if (last) {
      const auto past_m =
          first.from_m + static_cast<double>(*last + 1) * step_m;
      if (cleared_m_.empty())
        from_m_ = here_m - step_m;
      if (past_m > farthest_m)
        to_m_ = here_m;
      farthest_m = std::max(farthest_m, past_m);
    }
    if (std::isfinite(farthest_m))
      cleared_m_.push_back(farthest_m);
  }
  // From the last place at which anything changes on, it is as there.
  cleared_m_.resize(
      static_cast<std::size_t>(std::lround((to_m_ - from_m_) / step_m)));
  assert(std::ranges::is_sorted(cleared_m_));
}

double meeting_curve::cleared_m(double second_m) const {
  if (cleared_m_.empty() || second_m <= from_m_)
    return no_matter;
  // What lies between two steps is as at the later one.
  const auto steps = std::ceil((second_m - from_m_) / step_m - 1e-9);
  const auto i = static_cast<std::size_t>(std::max(1.0, steps)) - 1;
  assert(from_m_ < to_m_);
  return cleared_m_[std::min(i, cleared_m_.size() - 1)];
}

} // namespace sofof::world
